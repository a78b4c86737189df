# What bash offers: completion.bash SCRIPT WORD... prints what the last word completes to, one a line, and in brackets what it
# tells the shell of them.
# COMP_WORDBREAKS parts words at "=", as bash itself does.
source "$1"
shift
COMP_WORDS=()
for word; do
    while [[ $word == *=* && $word != = ]]; do
        before=${word%%=*}
        [ -z "$before" ] || COMP_WORDS+=("$before")
        COMP_WORDS+=("=")
        word=${word#*=}
        [ -n "$word" ] || continue 2
    done
    COMP_WORDS+=("$word")
done
COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
told=()
compopt() { told+=("[$*]"); } # heard only from the shell itself, as the real one
_ramify
[ ${#COMPREPLY[@]} -eq 0 ] || printf '%s\n' "${COMPREPLY[@]}"
[ ${#told[@]} -eq 0 ] || printf '%s\n' "${told[@]}"
