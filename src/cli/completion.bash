_ramify_scene() { # the scene that the command line names so far
    local word
    for word in "${COMP_WORDS[@]:2}"; do
        word=${word//[\\\'\"]/} # as it was typed
        case $word in "~/"*) word=$HOME${word:1} ;; esac
        if [[ $word == *.yaml && -f $word ]]; then
            echo "$word"
            return
        fi
    done
}

_ramify_paths() { # keys as --set takes them: of the scene if there is one
    local scene=$(_ramify_scene)
    if [ -z "$scene" ] || ! "${COMP_WORDS[0]}" info "$scene" --paths 2>/dev/null; then
        "${COMP_WORDS[0]}" schema --paths 2>/dev/null
    fi
}

_ramify_files() { # CURRENT ENDING...: files with these endings (none: all), and folders
    local current=$1 ending
    shift
    [ $# -gt 0 ] || compgen -f -- "$current"
    for ending; do
        compgen -f -X "!*.$ending" -- "$current"
    done
    [ $# -eq 0 ] || compgen -d -- "$current"
}

_ramify() {
    local IFS=$' \t\n' current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
    local command=${COMP_WORDS[1]} option= offer= scene= ending word number
    COMPREPLY=()
    if [ "$COMP_CWORD" -eq 1 ]; then
        COMPREPLY=($(compgen -W "$_ramify_commands --help --version" -- "$current"))
        return
    fi
    # bash takes "--option=value" apart into three words
    if [ "$current" = = ]; then
        current= option=$previous
    elif [ "$previous" = = ]; then
        option=${COMP_WORDS[COMP_CWORD-2]}
    elif [[ $previous == -* ]]; then
        option=$previous
    fi
    [[ -z $option || $option == -* ]] || return # the value after --set key=
    [ -z "$option" ] || offer=$(_ramify_offer "$command" "$option")
    if [ -z "$offer" ]; then
        [[ -z $option || $option == "$previous" ]] || return
        if [[ $current == -* ]]; then
            COMPREPLY=($(compgen -W "$(_ramify_options "$command")" -- "$current"))
            return
        fi
        offer=$(_ramify_offer "$command" "")
    fi
    set -- $offer
    # Folders get their slash and names their quotes; not in a subshell.
    case $1 in folder | file | output) compopt -o filenames 2>/dev/null ;; esac
    case $1 in
    words) COMPREPLY=($(compgen -W "${*:2}" -- "$current")) ;;
    command) COMPREPLY=($(compgen -W "$_ramify_commands" -- "$current")) ;;
    folder) mapfile -t COMPREPLY < <(compgen -d -- "$current") ;;
    file) mapfile -t COMPREPLY < <(_ramify_files "$current" "${@:2}") ;;
    output)
        mapfile -t COMPREPLY < <(_ramify_files "$current" "${@:2}")
        scene=$(_ramify_scene)
        for ending in ${scene:+"${@:2}"}; do
            number=
            [[ $command != turntable || $ending == mp4 ]] || number=-%04d # of the frame
            word=$(basename "$scene" .yaml)$number.$ending
            [[ $word != "${current//\\/}"* ]] || COMPREPLY+=("$word")
        done
        ;;
    set)
        compopt -o nospace 2>/dev/null
        mapfile -t COMPREPLY < <(_ramify_paths | awk -v current="$current" '
            index($0, current) == 1 {
                dot = index(substr($0, length(current) + 1), ".")
                print dot ? substr($0, 1, length(current) + dot) : $0 "="
            }' | sort -u)
        ;;
    object)
        scene=$(_ramify_scene)
        [ -z "$scene" ] || COMPREPLY=($(compgen -W "$("${COMP_WORDS[0]}" info "$scene" 2>/dev/null |
            awk '$1 == "object" {print $3}')" -- "$current"))
        ;;
    esac
}

complete -F _ramify ramify
