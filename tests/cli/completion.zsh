# What zsh offers: completion.zsh FOLDER_OF_THE_SCRIPT LINE prints what the end of LINE completes to, one a line. A shell in a
# pseudo-terminal completes; compadd is told to print what it is given, and the editor says when it waits and when it has done.
zmodload zsh/zpty || exit 2
zpty shell zsh -f -i
send() { zpty -w shell "$1" }
send "PROMPT=; fpath=(${(q)1} \$fpath); autoload -Uz compinit && compinit -u -D"
send 'compadd() {
    local -a words
    if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then builtin compadd "$@"; return; fi
    builtin compadd -O words "$@"
    print -rl -- "<"${^words}">"
    builtin compadd "$@"
}'
send 'tell() { zle complete-word; print "<>fini""shed" }; zle -N tell; bindkey "^I" tell'
send 'zle-line-init() { print "<>rea""dy" }; zle -N zle-line-init'
while zpty -r shell output; do [[ $output == *'<>ready'* ]] && break; done
zpty -w -n shell "$2"$'\t'
while zpty -r shell output; do
    [[ $output == *'<>finished'* ]] && break
    print -r -- $output
done | grep -o '<[^<>]\+>' | tr -d '<>' | sort -u
zpty -d shell
