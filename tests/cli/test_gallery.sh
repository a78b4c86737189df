#!/bin/sh
# docs/gallery.sh goes on where an interrupted run was: it takes the panels that a sheet has, makes the rest, and joins them in
# their order. A program in ramify's place writes its arguments as the picture and is interrupted at a given call; one in
# oiiotool's place joins by writing the panels one after the other.
set -u
checks=$(realpath "$(dirname "$0")/checks.sh")
script=$(realpath "$(dirname "$0")/../../docs/gallery.sh")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
. "$checks"

mkdir docs scenes renders bin
cp "$script" docs/
touch -d '1 hour ago' scenes/guide-field-sphere.yaml
cat >bin/ramify <<'EOF2'
#!/bin/sh
echo "$*" >>calls
[ "$(wc -l <calls)" -ne "${INTERRUPTED_AT:-0}" ] || exit 130
while [ "$1" != -o ]; do shift; done
echo "$*" >"$2"
EOF2
cat >bin/oiiotool <<'EOF2'
#!/bin/sh
panels=
while [ "$1" != -o ]; do
    case $1 in build/*.png) panels="$panels $1" ;; esac
    shift
done
cat $panels >"$2"
EOF2
chmod +x bin/*
PATH=$folder/bin:$PATH RAMIFY=$folder/bin/ramify
export PATH RAMIFY

calls() { wc -l <calls; }
turns() { sed 's/.*turn=//' renders/figure-8.jpg | tr '\n' ' '; }

check interrupted 130 env INTERRUPTED_AT=2 docs/gallery.sh figure-8
yes no_sheet_of_a_part [ ! -e renders/figure-8.jpg ]
check goes_on 0 docs/gallery.sh figure-8
yes first_panel_once [ "$(calls)" -eq 4 ] # turn 0, 120 interrupted, 120, 360
yes in_their_order [ "$(turns)" = "0 120 360 " ]

check anew_by_name 0 docs/gallery.sh figure-8
yes all_panels_anew [ "$(calls)" -eq 7 ]

check interrupted_again 130 env INTERRUPTED_AT=9 docs/gallery.sh figure-8
touch -d '1 hour' scenes/guide-field-sphere.yaml # newer than the panel that is done
check scene_changed 0 docs/gallery.sh figure-8
yes old_panel_not_taken [ "$(calls)" -eq 12 ]
yes order_kept [ "$(turns)" = "0 120 360 " ]
