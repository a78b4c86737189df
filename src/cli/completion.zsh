_ramify_scene() { # the scene that the command line names so far
    local word
    for word in ${(Q)words}; do
        word=${word/#\~\//$HOME/}
        if [[ $word == *.yaml && -f $word ]]; then
            print -r -- $word
            return
        fi
    done
}

_ramify_offer() { # KIND [WORD...]: as the calls in _ramify_command say
    local kind scene key rest
    local -aU found
    kind=$1
    shift
    case $kind in
    words) compadd -- "$@" ;;
    command) _describe command _ramify_commands ;;
    folder) _files -/ ;;
    file) if (( $# )); then _files -g "*.(${(j:|:)@})(-.)"; else _files; fi ;;
    output)
        scene=$(_ramify_scene)
        if [[ -n $scene && $words[1] == turntable ]]; then # frames have numbers
            for key; do
                if [[ $key == mp4 ]]; then found+=(${scene:t:r}.mp4); else found+=(${scene:t:r}-%04d.$key); fi
            done
            compadd -a found
        elif [[ -n $scene ]]; then
            compadd -- ${scene:t:r}.$^@
        fi
        _files -g "*.(${(j:|:)@})(-.)"
        ;;
    set)
        scene=$(_ramify_scene)
        for key in ${(f)"$({ [[ -n $scene ]] && $_ramify_program info $scene --paths 2>/dev/null } ||
            $_ramify_program schema --paths 2>/dev/null)"}; do
            [[ $key == ${PREFIX}* ]] || continue
            rest=${key#$PREFIX}
            if [[ $rest == *.* ]]; then found+=($PREFIX${rest%%.*}.); else found+=($key=); fi
        done
        compadd -Q -S '' -a found
        ;;
    object)
        scene=$(_ramify_scene)
        [[ -z $scene ]] ||
            compadd -- ${(f)"$($_ramify_program info $scene 2>/dev/null | awk '$1 == "object" {print $3}')"}
        ;;
    *) _message value ;;
    esac
}

_ramify() {
    local _ramify_program=${(Q)words[1]}
    if (( CURRENT == 2 )); then
        _describe command _ramify_commands
        return
    fi
    shift words
    (( CURRENT-- ))
    _ramify_command $words[1]
}

