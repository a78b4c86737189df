#!/bin/sh
# The manual: what is generated is up to date, links lead somewhere, examples run. RAMIFY names the binary.
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
root=$PWD
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
# verdict NAME: "ok" when the file `wrong` is empty, else what it holds.
verdict() {
    if [ -s wrong ]; then echo "not ok $1"; cat wrong; else echo "ok $1"; fi
}

# ---- docs/scene.md ----

"$RAMIFY" schema --markdown >scene.md
if diff "$root/docs/scene.md" scene.md >wrong; then :; else echo "docs/scene.md is stale: make docs" >>wrong; fi
verdict scene_reference_is_fresh

# Every key of the JSON Schema has a row; every row has all four cells.
"$RAMIFY" schema | awk '/"\$defs"/ {defs = 1} !(defs && /^    "/)' | sed -n 's/^ *"\([a-z0-9_]*\)": {"description".*/\1/p' | sort -u >keys
[ "$(wc -l <keys)" -gt 200 ] || echo "few keys in the schema" >keys
sed -n 's/^| `\([a-z0-9_]*\)` | .* | .* | ..* |$/\1/p' scene.md | sort -u >rows
comm -23 keys rows >wrong
verdict scene_reference_has_every_key

# Links of the documents: #sections as GitHub names them, and files.
sections_of() { sed -n 's/^##* //p' "$1" | tr 'A-Z ' 'a-z-' | tr -cd 'a-z0-9_\n-' | sort; }
for document in "$root"/README.md "$root"/docs/*.md; do
    sections_of "$document" >sections
    sort -u sections | comm -23 sections - | sed "s|^|${document##*/}: two sections are called |"
    grep -oE '\]\([^)]+\)' "$document" | sed 's/^](//; s/)$//' | sort -u | while read -r link; do
        case $link in
        \#*) grep -qxF -- "${link#\#}" sections ;;
        http*) ;;
        *.md\#*) sections_of "$(dirname "$document")/${link%%\#*}" | grep -qxF -- "${link#*\#}" ;;
        *) [ -e "$(dirname "$document")/${link%%\#*}" ] ;;
        esac || echo "${document##*/}: no $link"
    done
done >wrong
verdict links_resolve

# Examples of the reference: pieces of a scene; what lacks objects gets one.
: >meadow.png >heights.tif
printf "1 1 0 0 0 5 -1\n2 3 0 20 0 1 1\n" >neuron.swc
awk '/^```yaml$/ {n++; inside = 1; next} /^```$/ {inside = 0} inside {print > sprintf("example-%02d.yaml", n)}' scene.md
: >wrong
count=0
for example in example-*.yaml; do
    grep -q '^objects:' "$example" || printf 'objects: [{name: land, ground: {}}]\n' >>"$example"
    "$RAMIFY" info "$example" >out 2>&1 || cat out "$example" >>wrong
    count=$((count + 1))
done
[ "$count" -ge 20 ] || echo "only $count examples" >>wrong
verdict scene_reference_examples_are_valid

# ---- man pages ----

commands=$("$RAMIFY" --help | sed -n 's/^  ramify \([a-z]*\) .*/\1/p')
[ "$(echo "$commands" | wc -l)" -gt 5 ] || echo "few commands in the help" >wrong
for command in $commands; do
    "$RAMIFY" help "$command" --man >"ramify-$command.1" || echo "no page of $command"
done >>wrong
"$RAMIFY" help --man >ramify.1 || echo "no page of ramify" >>wrong
for command in $commands; do
    grep -qx "\.Xr ramify.-$command 1 \." ramify.1 || echo "ramify.1 does not name $command"
    grep -q '^\.Sh EXAMPLES' "ramify-$command.1" || echo "ramify-$command.1 has no examples"
done >>wrong
verdict man_pages_of_all_commands

if command -v mandoc >/dev/null; then
    for page in ramify*.1; do mandoc -T lint -W warning "$page"; done >wrong 2>&1
    verdict man_pages_lint
else
    echo "skipped man_pages_lint: mandoc is not installed"
fi

: >wrong
"$RAMIFY" completion fish >out 2>err
[ $? -eq 2 ] && [ ! -s out ] && grep -q "'fish'; it must be bash or zsh" err || cat out err >>wrong
"$RAMIFY" help nonsense --man >out 2>err
[ $? -eq 2 ] && [ ! -s out ] && grep -q "unknown command 'nonsense'" err || cat out err >>wrong
"$RAMIFY" help rendr >out 2>err
[ $? -eq 2 ] && [ ! -s out ] && grep -q "did you mean 'render'?" err || cat out err >>wrong
verdict manual_refusals

# What `make install` puts there are the pages of all commands.
: >wrong
for command in $commands; do
    grep -qE "^COMMANDS +:=.* $command( |\$)" "$root/Makefile" || echo "Makefile: COMMANDS lacks $command"
done >wrong
verdict man_pages_are_installed

# The examples run, with pictures made small and a scene that takes no time.
cat >pine.yaml <<'END'
camera: {position: [0, 1.5, 7], target: [0, 1.4, 0]}
film: {width: 32, height: 20}
render: {samples: 1}
objects:
  - name: pine
    tree: {height: 3, crown: {lobes: 0, growth: {levels: [{attractors: 60}]}}, leaves: {max_count: 50}}
targets: [{object: pine, measure: height, low: 2, high: 12}]
END
mkdir -p bin
cat >bin/ramify <<END
#!/bin/sh
case "\$*" in
render*--sample-range*) exec "$RAMIFY" "\$@" --size 32x20 --quiet ;; # of the samples that the example names
render*) exec "$RAMIFY" "\$@" --size 32x20 --samples 1 --quiet ;;
turntable*) exec "$RAMIFY" "\$@" --size 32x20 --samples 1 --frames 3 --quiet ;;
*) exec "$RAMIFY" "\$@" ;;
esac
END
printf '#!/bin/sh\necho 1\n' >bin/sbatch # examples for a cluster
chmod +x bin/ramify bin/sbatch
mkdir -p golden && cp pine.yaml golden/
"$RAMIFY" render pine.yaml -o a.png --quiet && cp a.png b.png && cp a.exr b.exr && cp a.exr pine.exr
count=0
for page in ramify*.1; do
    awk '/^\.Bd -literal/ {inside = 1; next} /^\.Ed/ {inside = 0} inside' "$page" |
        sed 's/\\-/-/g; s/\\&//g; s/\\e/\\/g' >lines
    [ -s lines ] || echo "no example in $page"
    while read -r line; do
        PATH=$PWD/bin:$PATH bash -c "set -o pipefail; $line" >out 2>&1 </dev/null || {
            echo "$page: $line"
            cat out
        }
    done <lines
done >wrong
verdict man_page_examples_run

# ---- completion ----

"$RAMIFY" completion bash >bash-script
mkdir -p zsh-folder sub
"$RAMIFY" completion zsh >zsh-folder/_ramify
touch survey.asc notes.txt

# Every option of every command, and every word of the help, is in help, page and both scripts.
for command in $commands; do
    "$RAMIFY" "$command" --help | sed -n 's/^  \(-[a-z], \)\{0,1\}--\([a-z-]*\).*/\2/p' >options
    [ "$command" != help ] || printf 'man\nhelp\n' >options # its --help is the program's
    grep -qx help options || echo "$command has no --help"
    sed -n "s/^    $command) echo \"\(.*\)\" ;;/ \1 /p" bash-script >of-bash
    awk -v name="    $command)" '$0 == name {inside = 1; next} inside && /;;/ {exit} inside' zsh-folder/_ramify >of-zsh
    while read -r option; do
        sed 's/\\-/-/g' "ramify-$command.1" | grep -qE "^\.It (Fl . , )?Fl --*$option( |\$)" || echo "page of $command: no --$option"
        grep -q -- " --$option " of-bash || echo "bash: no $command --$option"
        grep -qE -- "--$option[]=[}]" of-zsh || echo "zsh: no $command --$option"
    done <options
done >wrong
verdict every_option_is_documented

# offers SHELL NAME LINE WORD...: at the end of LINE these words are offered, among others; "!WORD": not offered.
offers() {
    shell=$1 name=$2 line=$3
    shift 3
    if [ "$shell" = bash ]; then
        # Word splitting is meant; a blank at the end begins an empty word.
        # shellcheck disable=SC2086
        case $line in *' ') set -- $line '' -- "$@" ;; *) set -- $line -- "$@" ;; esac
        : >typed
        while [ "$1" != -- ]; do
            printf '%s\0' "$1" >>typed
            shift
        done
        shift
        PATH=$PWD/bin:$PATH xargs -0 bash "$root/tests/cli/completion.bash" ./bash-script <typed >offered 2>&1
    else
        PATH=$PWD/bin:$PATH timeout 30 zsh -f "$root/tests/cli/completion.zsh" zsh-folder "$line" >offered 2>&1
    fi
    for word; do
        case $word in
        !*) ! grep -qxF -- "${word#!}" offered || echo "offers ${word#!}" ;;
        *) grep -qxF -- "$word" offered || { echo "does not offer $word but:"; cat offered; } ;;
        esac
    done >wrong
    verdict "completion_${shell}_$name"
}
for shell in bash zsh; do
    if ! command -v $shell >/dev/null; then
        echo "skipped completion_$shell: $shell is not installed"
        continue
    fi
    offers $shell command "ramify re" render '!grow'
    offers $shell option "ramify render pine.yaml --sa" --samples '!--size'
    offers $shell scene "ramify render " pine.yaml '!notes.txt' '!survey.asc'
    offers $shell measured "ramify measure s" survey.asc '!pine.yaml'
    offers $shell isa "ramify render pine.yaml --isa a" avx2 avx512 '!sse2'
    offers $shell isa_of_golden "ramify golden --isa n" native
    offers $shell ending "ramify export pine.yaml -o pine." pine.glb pine.obj '!pine.jpg'
    offers $shell object "ramify export pine.yaml --object " pine
    offers $shell key "ramify render pine.yaml --set camera.fo" camera.fov= camera.focal_length= '!film.'
    offers $shell varied "ramify fit pine.yaml --vary objects.pine.tree.h" objects.pine.tree.height=
    offers $shell engine "ramify batch pine.yaml --engine s" slurm '!local'
    offers $shell batch "ramify batch status s" sub
    offers $shell until "ramify fit pine.yaml --until t" targets '!evaluations'
    offers $shell object_key "ramify render pine.yaml --set objects.pine.tree.h" objects.pine.tree.height=
    offers $shell value "ramify render pine.yaml --set sky.kind=" '!pine.yaml'
    offers $shell frames "ramify turntable pine.yaml -o pine" pine-%04d.png pine.mp4 '!pine-%04d.mp4'
    offers $shell shell "ramify completion z" zsh '!bash'
done
# So that folders get a slash and names with blanks their quotes.
for line in "ramify render s" "ramify golden s" "ramify export pine.yaml -o s"; do
    offers bash "names_of_$(echo "$line" | cut -d" " -f2)" "$line" sub "[-o filenames]"
done

# ---- docs/tutorial.md ----

# Its scenes, as files and as it shows them.
mkdir -p tutorial
cp "$root"/docs/tutorial/*.yaml tutorial
cd tutorial || exit 1
for scene in [2-9]*.yaml; do
    "$RAMIFY" info "$scene" >out 2>&1 || { echo "$scene:"; cat out; }
done >../wrong
awk '/^```yaml$/ {n++; inside = 1; next} /^```$/ {inside = 0} inside {print > sprintf("../piece-%02d.yaml", n)}' "$root/docs/tutorial.md"
# Each step from the second shows its whole scene as its file has it, in order.
number=0
for scene in [2-9]*.yaml; do
    number=$((number + 1))
    piece=$(printf '../piece-%02d.yaml' "$number")
    diff "$scene" "$piece" || echo "$scene is not what step $((number + 1)) shows"
done >>../wrong 2>&1
[ "$(ls ../piece-*.yaml | wc -l)" = "$number" ] || echo "pieces that belong to no step" >>../wrong
(cd .. && verdict tutorial_scenes)

# Its commands run, with pictures made small and growth as it is.
awk '/^```sh$/ {inside = 1; next} /^```$/ {inside = 0} inside' "$root/docs/tutorial.md" >../lines
[ "$(wc -l <../lines)" -ge 5 ] || echo "few commands" >../wrong
while read -r line; do
    PATH=$folder/bin:$PATH sh -c "$line" >out 2>&1 </dev/null || { echo "$line"; cat out; }
done <../lines >../wrong
(cd .. && verdict tutorial_commands)

# Its dialogues: what follows "$ command" is what the command says.
awk '/^```console$/ {inside = 1; next} /^```$/ {inside = 0} inside' "$root/docs/tutorial.md" >../lines
while IFS= read -r line; do
    case $line in
    '$ '*) PATH=$folder/bin:$PATH sh -c "${line#??}" >out 2>&1 </dev/null ;;
    *) grep -qF -- "$line" out || { echo "no '$line' in:"; cat out; } ;;
    esac
done <../lines >../wrong
(cd .. && verdict tutorial_dialogues)
cd ..
