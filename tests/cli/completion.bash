# What bash offers: completions.bash SCRIPT WORD... prints what the last word completes to, one a line.
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
_ramify
[ ${#COMPREPLY[@]} -eq 0 ] || printf '%s\n' "${COMPREPLY[@]}"
