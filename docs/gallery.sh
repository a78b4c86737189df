#!/bin/sh
# Renders the pictures of README.md and docs/gallery.md into renders/: all of them, or those named on the command line, and tells the
# seconds that each took and its noise before denoising (docs/rendering.md; of a sheet the mean of the panels drawn).
# Interrupted, a run goes on where it was: build/gallery/ holds unfinished pictures, the panels of unfinished sheets and, for
# runs without names, what tells which pictures are done since their scenes were last changed. Remove the folder to start
# anew.
# --times: renders nothing, but tells the seconds that each takes on two cores: half the processor time that
# ramify info --estimate foresees.
# usage: docs/gallery.sh [--times] [NAME...]
set -e
cd "$(dirname "$0")/.."
ramify=${RAMIFY:-build/ramify}
estimates=
if [ "$1" = --times ]; then
    estimates=yes
    shift
fi
wanted=" $* " panels=
work=build/gallery
mkdir -p "$work"
parts=$(mktemp -d)
trap 'rm -rf "$parts"' EXIT

is_wanted() { [ "$wanted" = "  " ] || case $wanted in *" $1 "*) ;; *) false ;; esac; }

# is_done NAME SCENE: an earlier run without names has made the still from the scene as it is.
is_done() { [ "$wanted" = "  " ] && [ -n "$(find "$work" -name "$1.done" -newer "scenes/$2.yaml")" ]; }

# estimate SCENE [OPTION...]: adds half of the processor seconds of a picture to $seconds.
estimate() {
    scene=$1
    shift
    "$ramify" info "scenes/$scene.yaml" --estimate --json --quiet "$@" >"$parts/estimate"
    seconds=$(sed 's/.*"seconds": {//; s/[^0-9. ]//g' "$parts/estimate" |
        awk -v sum="${seconds:-0}" '{ for (i = 1; i <= NF; i++) sum += $i / 2 } END { printf "%.2f", sum }')
}

# draw FILE SCENE [OPTION...]: renders a picture and adds its noise, in percent, to $noises.
draw() {
    file=$1 scene=$2
    shift 2
    "$ramify" render "scenes/$scene.yaml" -o "$file" --no-preview --json "$@" >"$parts/told"
    noises="$noises $(sed -n 's/.*"noise": \([0-9.]*\),.*/\1/p' "$parts/told")"
    rm -f "$parts/told"
}

# tell NAME: the seconds since $began, and the mean noise of the pictures that were drawn; or, with --times, the estimate.
tell() {
    if [ -n "$estimates" ]; then
        printf '%s: %.0f s\n' "$1" "$seconds"
    else
        echo "$noises" | awk -v name="$1" -v seconds=$(($(date +%s) - began)) '{
            for (i = 1; i <= NF; i++) sum += 100 * $i / NF
            printf (NF ? "%s: %d s, noise %.1f %%\n" : "%s: %d s\n"), name, seconds, sum
        }'
    fi
    noises='' seconds=0 began=$(date +%s)
}
began=$(date +%s)

# lacks NAME SCENE: the scene needs a file that is not ramify's, named in its line "# survey: FILE", and it is not there.
lacks() {
    survey=$(sed -n 's/^# survey: //p' "scenes/$2.yaml")
    [ -n "$survey" ] && [ ! -e "scenes/$survey" ] || return 1
    echo "$1: skipped, for scenes/$survey is missing: scenes/$2.yaml tells where to get it"
}

# still NAME SCENE [OPTION...]: renders SCENE to renders/NAME.jpg.
still() {
    is_wanted "$1" || return 0
    ! lacks "$1" "$2" || return 0
    if [ -n "$estimates" ]; then
        name=$1
        shift
        estimate "$@"
        tell "$name"
        return
    fi
    ! is_done "$1" "$2" || return 0
    name=$1 scene=$2 noises='' began=$(date +%s)
    shift 2
    # an unfinished picture of the scene before a change cannot go on
    [ "$work/$name.exr" -nt "scenes/$scene.yaml" ] || rm -f "$work/$name.exr"
    draw "$work/$name.png" "$scene" --resume "$@"
    for quality in 90 84 78; do # at most 900 KB
        oiiotool "$work/$name.png" --ch R,G,B --compression "jpeg:$quality" -o "renders/$name.jpg"
        [ "$(wc -c <"renders/$name.jpg")" -gt 900000 ] || break
    done
    rm -f "$work/$name.png" "$work/$name.exr"
    : >"$work/$name.done"
    tell "$name"
}

# fine NAME SCENE SAMPLES: the same of 1920 x 1080, traced and denoised at twice the width and height with SAMPLES a pixel, for
# what is full of leaves and twigs.
fine() { still "$1" "$2" --size 3840x2160 --samples "$3" --set film.downsample=2; }

# movie NAME SCENE FRAMES FILTER TURNING [OPTION...]: renders the film of SCENE to renders/NAME.webp, 480 pixels wide, cut by
# ffmpeg's FILTER. TURNING: options of turntable alone. Its estimate is that of FRAMES stills, each grown anew.
movie() {
    is_wanted "$1" || return 0
    name=$1 scene=$2 frames=$3 filter=$4 turning=$5 began=$(date +%s)
    shift 5
    if [ -n "$estimates" ]; then
        estimate "$scene" "$@"
        seconds=$(awk -v one="$seconds" -v frames="$frames" 'BEGIN { print one * frames }')
        tell "$name"
        return
    fi
    # shellcheck disable=SC2086 # several options
    "$ramify" turntable "scenes/$scene.yaml" -o "$parts/film.mp4" --frames "$frames" $turning "$@"
    ffmpeg -v error -i "$parts/film.mp4" -vf "$filter,scale=480:-1:flags=lanczos,fps=12" -c:v libwebp_anim -loop 0 \
        -quality 66 -compression_level 5 -y "renders/$name.webp"
    rm -rf "$parts"/*
    tell "$name"
}

# panel SCENE [OPTION...]: renders one picture of the next sheet, or takes it from an interrupted run. A run without names also
# takes it from the sheet that an earlier one has finished. A checksum of the scene's name and the options tells them apart.
panel() {
    if [ -n "$estimates" ]; then
        estimate "$@"
        return
    fi
    scene=$1 panel=$work/panel-$(printf '%s\n' "$@" | cksum | tr ' ' -)
    shift
    panels="$panels $panel.png"
    [ "$wanted" != "  " ] || [ ! -e "$panel.used.png" ] || mv "$panel.used.png" "$panel.png"
    [ ! "$panel.png" -nt "scenes/$scene.yaml" ] || return 0
    [ "$panel.part.exr" -nt "scenes/$scene.yaml" ] || rm -f "$panel.part.exr"
    draw "$panel.part.png" "$scene" --resume "$@"
    rm -f "$panel.part.exr"
    mv "$panel.part.png" "$panel.png"
}

# join NAME COLUMNSxROWS PICTURE...: joins pictures into renders/NAME.jpg, of at most 900 KB.
join() {
    name=$1 grid=$2
    shift 2
    for quality in 90 84 78 72 66; do
        oiiotool "$@" --mosaic:pad=4 "$grid" --ch R,G,B --compression "jpeg:$quality" -o "renders/$name.jpg"
        [ "$(wc -c <"renders/$name.jpg")" -gt 900000 ] || break
    done
}

# sheet NAME COLUMNSxROWS: joins the panels since the last sheet into renders/NAME.jpg.
sheet() {
    if [ -n "$estimates" ]; then
        tell "$1"
        return
    fi
    # shellcheck disable=SC2086 # names without spaces
    join "$1" "$2" $panels
    for file in $panels; do [ ! -e "$file" ] || mv "$file" "${file%.png}.used.png"; done
    panels=
    tell "$1"
}

# A sheet's lines:
#   if is_wanted figure-7; then
#       panel some-scene --size 426x720 --set ...
#       sheet figure-7 3x1
#   fi

# ---- points and out-trees ----

# figure 1 is a sheet of other pictures of the gallery
if is_wanted figure-1 && [ -z "$estimates" ]; then
    set --
    for picture in forest frost-window lightning vessels-organ mountains sculpture; do
        oiiotool "renders/$picture.jpg" --resize 560x315 -o "$parts/$picture.png"
        set -- "$@" "$parts/$picture.png"
    done
    join figure-1 3x2 "$@"
    rm -f "$parts"/*
fi
if is_wanted figure-2; then
    for step in 0 0.25 0.6 1; do
        panel outtree-plane --set grow_to="$step"
    done
    sheet figure-2 2x2
fi
still figure-3 outtree-band
still figure-4 outtree-placement
if is_wanted figure-5; then
    panel outtree-groups --set grow_to=0
    panel outtree-groups
    sheet figure-5 2x1
fi
if is_wanted figure-6; then
    panel outtree-groups --set objects.groups.outtree.growth.levels.0.kill=0.01 --set objects.groups.outtree.growth.levels.0.influence=9
    panel outtree-groups --set objects.groups.outtree.growth.levels.0.kill=1.3 --set objects.groups.outtree.growth.max_children=2
    sheet figure-6 2x1
fi
still outtree-frost outtree-frost
still outtree-lightning outtree-lightning

still sculpture sculpture --size 1920x1080
still dla dla
still neuron neuron
still fracture fracture
still venation venation

# ---- vessels ----

still figure-14 vessels-forks
fine vessels-organ vessels-organ 14
still vessels-body vessels-body
if is_wanted figure-15; then
    for share in 0.15 0.6 0.9 1; do
        panel vessels-growth --set grow_to=$share --size 480x864 --set objects.vessels.vessels.terminals=3000 --set camera.aperture=0 \
            --set camera.position='[0.55, 1.02, 5.4]' --set camera.target='[0, 0.885, 0]' --set camera.fov=19.6
    done
    sheet figure-15 4x1
fi

# ---- trees, fields, forest ----

fine oak oak 8
fine oak-winter oak-winter 6
still ash ash
still figure-9 field-grid
still twisted twisted
still mesh-crown mesh-crown
fine forest forest 4
if is_wanted figure-10; then
    for time in 0.2 0.45 0.62 0.8 0.9 1; do
        panel oak --size 640x540 --denoise --samples 16 --set camera.fov=34 \
            --set camera.target="[-1, 6, 0]" --set grow_to="$time"
    done
    sheet figure-10 3x2
fi
if is_wanted figure-18; then
    for tree in tree-plain tree-field-crown tree-field-trunk tree-field-dragon; do
        panel "$tree" --size 960x540 --samples 12
    done
    sheet figure-18 2x2
fi
still lightning lightning
still lightning-surface lightning-surface
if is_wanted figure-11; then
    for share in 0.3 0.55 0.8 0.97 1; do panel lightning-growth --set grow_to=$share --size 400x664 --samples 10; done
    sheet figure-11 5x1
fi
if is_wanted figure-12; then
    for share in 0.2 0.45 0.7 1; do
        panel lightning-hare --set grow_to=$share --size 960x540 --samples 24
    done
    sheet figure-12 2x2
fi
# row SCENE POSITION TARGET FOV: a row of trees as a camera sees it, traced at twice the width and height.
row() {
    panel "$1" --size 5120x1360 --samples 3 --set film.downsample=2 --set camera.position="$2" --set camera.target="$3" --set camera.fov="$4"
}
# species_rows NAME: a sheet of the five rows, each with its own camera.
species_rows() {
    is_wanted "$1" || return 0
    row "$1" '[0, 107.39, 592.61]' '[0, 13.53, 0]' 3.3699
    row "$1" '[0, 102.60, 1192.61]' '[0, 8.74, 600]' 2.1770
    row "$1" '[0, 101.33, 1792.61]' '[0, 7.47, 1200]' 1.8619
    row "$1" '[0, 97.16, 2392.61]' '[0, 3.30, 1800]' 0.8212
    row "$1" '[0, 96.39, 2992.61]' '[0, 2.53, 2400]' 0.6302
    sheet "$1" 1x5
}
species_rows species
species_rows species-winter
still ivy-wall ivy-wall
still olive-trunk olive-trunk
still pine-rock pine-rock
still leaves-sun leaves-sun
fine willow-lake willow-lake 5
fine pond pond 5
still cherry-blossom cherry-blossom
still beech-wood beech-wood
still birch-grove birch-grove
still spruce-snow spruce-snow
still forest-fog forest-fog
fine hoar-birch hoar-birch 4
still hoar-fence hoar-fence
still lsystem-fern lsystem-fern
still figure-19 lsystem-tree --size 1600x900
if is_wanted coral-figure-2; then
    panel coral-figure-2 --size 800x600
    panel coral-figure-2-b --size 800x600
    panel coral-figure-2 --size 800x600 --set objects.coral.coral.rule=mean
    panel coral-figure-2 --size 800x600 --set objects.coral.coral.rule=mean --set objects.coral.coral.colonies=2 \
        --set objects.coral.coral.size=0.52 --set objects.coral.coral.height=0.6
    sheet coral-figure-2 2x2
fi
still coral-reef coral-reef
still coral-staghorn coral-staghorn

# ---- frost ----
still frost-window frost-window
still frost-bubble frost-bubble
still frost-flowers frost-flowers
if is_wanted figure-7; then
    for turn in 0 120 360; do
        for step in 0.25 0.5 1; do
            panel guide-field-plane --size 640x640 --set "objects.tree.frost.turn=$turn" --set grow_to="$step"
        done
    done
    sheet figure-7 3x3
fi
if is_wanted figure-8; then
    for turn in 0 120 360; do
        panel guide-field-sphere --size 960x960 --set "objects.tree.frost.turn=$turn"
    done
    sheet figure-8 3x1
fi
if is_wanted figure-13; then
    for step in 0.12 0.3 0.55 1; do
        panel frost-window --size 800x450 --set grow_to="$step"
    done
    sheet figure-13 2x2
fi
if is_wanted figure-20; then
    for turn in 0 120 360 720; do
        panel frost-bubble-turn --set "objects.frost.frost.turn=$turn"
    done
    sheet figure-20 2x2
fi

# ---- terrain ----
still mountains mountains
still badlands badlands
still canyon canyon
still alps alps
still tarn tarn
still alpine-valley alpine-valley
still tiles tiles
still volcano volcano
still waterfall waterfall
still hills hills
still valley-fog valley-fog
still braided braided
still dunes dunes
still rainbow rainbow
still storm storm
still sea sea
still snow-crystal snow-crystal
movie oak-year oak-year 120 null ""
# walls of firs on four sides, as the bubble turns before the sun; the picture's edge is cut where they end
walls='{shape: box, size: [7.4, 0.98, 0.2], position: [0, 0, -3.6]}, {shape: box, size: [7.4, 0.98, 0.2], position: [0, 0, 3.6]}'
walls="$walls, {shape: box, size: [0.2, 0.98, 7.4], position: [-3.6, 0, 0]}, {shape: box, size: [0.2, 0.98, 7.4], position: [3.6, 0, 0]}"
movie frost-bubble-turn frost-bubble 60 crop=456:256:12:14 "--spin --turns 1 --grow 0.16:0.6 --fps 12" --size 480x270 \
    --samples 16 --set "objects.wood.shape.envelope=[$walls]"
still coast coast
still karst karst
still meander meander
still delta delta
if is_wanted figure-16; then
    for iterations in 1 2 4 8; do
        panel terrain-noise --set objects.noise.terrain.noise.iterations=$iterations
    done
    sheet figure-16 2x2
fi
if is_wanted figure-17; then
    land=objects.massif.terrain
    stage() { # MATERIAL [OPTION...]: the massif before it has its own colours
        material=$1
        shift
        panel terrain-ridges --set $land.water_level=0 --set objects.massif.material="$material" "$@"
    }
    stage relief --set $land.show=tree
    stage altitude --set $land.show=map --set $land.noise.iterations=0
    stage altitude --set $land.noise.iterations=0
    stage relief --set $land.noise.iterations=0
    stage relief
    panel terrain-ridges
    sheet figure-17 2x3
fi
if is_wanted figure-21; then
    panel terrain-strip --set seed=8 --set objects.range.terrain.water_level=0.16 --set camera.position='[0, 1400, 5400]' \
        --set camera.target='[0, 252, 0]' --set camera.fov=30
    panel terrain-strip --set 'objects.range.terrain.rivers.fields=[{kind: vortex, vector: [0, 1, 0], center: [0, 0, 0]}]'
    panel terrain-strip --set objects.range.terrain.rivers.count=150 --set objects.range.terrain.relief=1000 \
        --set objects.range.terrain.erosion.streams=1
    panel terrain-strip --set objects.range.material=badlands --set objects.range.terrain.relief=500 \
        --set objects.range.terrain.terraces.count=7 --set objects.range.terrain.terraces.strength=0.9 \
        --set objects.range.terrain.rivers.water=0 --set camera.position='[0, 800, 2700]' --set camera.target='[0, 120, 0]'
    sheet figure-21 2x2
fi
