# What tests of the command share, to be sourced from a folder of the test's own, in which out, err and log are written.

# check NAME STATUS COMMAND...: runs the command, wants this exit status; output goes to out, err.
check() {
    name=$1 wanted=$2
    shift 2
    "$@" >out 2>err
    status=$?
    if [ "$status" -eq "$wanted" ]; then echo "ok $name"; else
        echo "not ok $name"
        echo "   exit status $status, not $wanted: $*"
        cat out err
    fi
}
# says NAME FILE TEXT: the last command wrote this text there.
says() {
    if grep -qF -- "$3" "$2"; then echo "ok $1"; else
        echo "not ok $1"
        echo "   no '$3' in:"
        cat "$2"
    fi
}
# matches NAME FILE PATTERN: the last command wrote what a basic regular expression matches.
matches() {
    if grep -q -- "$3" "$2"; then echo "ok $1"; else
        echo "not ok $1"
        echo "   nothing like '$3' in:"
        cat "$2"
    fi
}
# yes NAME COMMAND...: the command succeeds; what it says goes to log.
yes() {
    name=$1
    shift
    if "$@" >log 2>&1; then echo "ok $name"; else
        echo "not ok $name"
        cat log
    fi
}
