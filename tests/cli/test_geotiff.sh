#!/bin/sh
# GeoTIFFs of heights and maps as gdalinfo reads them. RAMIFY: the program.
# Prints "ok NAME", "not ok NAME" or "skipped NAME: what is missing" for each case.
work=$(mktemp -d)
here=$(cd "$(dirname "$0")" && pwd)
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
. "$here/checks.sh"

cat >land.yaml <<EOF
objects:
  - name: land
    terrain: {form: noise, size: 640, resolution: 64, noise: {iterations: 4}, erosion: {thermal: 0.5}}
EOF
check heights 0 "$RAMIFY" grow land.yaml -o heights.tif --quiet
check map 0 "$RAMIFY" grow land.yaml --map deposit -o deposit.tif --quiet
check again 0 "$RAMIFY" grow land.yaml -o again.tif --threads 3 --quiet
yes same_bytes cmp heights.tif again.tif

# A survey: 40 x 30 samples of 20 m with the reference system of a national grid.
{
    printf 'ncols 40\nnrows 30\nxllcorner 2600000\nyllcorner 1200000\ncellsize 20\n'
    seq 1200
} >survey.asc
cat >survey.yaml <<EOF
objects:
  - name: land
    terrain:
      {form: survey, size: 320, resolution: 32, survey: {file: survey.tif, center: [60, -40]},
       rivers: {water: 0}, noise: {iterations: 0}}
EOF
if ! command -v gdalinfo >/dev/null || ! command -v gdal_translate >/dev/null; then
    echo "skipped geotiff_by_gdalinfo: gdalinfo (gdal-bin) is not installed"
    exit 0
fi
check info 0 gdalinfo -stats heights.tif
says info_driver out "Driver: GTiff/GeoTIFF"
says info_size out "Size is 65, 65"
says info_origin out "Origin = (-325.000000000000000,325.000000000000000)"
says info_pixel out "Pixel Size = (10.000000000000000,-10.000000000000000)"
says info_type out "Type=Float32"
says info_nodata out "NoData Value=-9999"
says info_metres out 'LENGTHUNIT["metre",1'
check info_map 0 gdalinfo -stats deposit.tif
matches info_map_lowest out "STATISTICS_MINIMUM=0$"

# The same samples as the ASCII grid has, in the same places.
check asc 0 "$RAMIFY" grow land.yaml -o heights.asc --quiet
check translate 0 gdal_translate -q -of AAIGrid heights.tif translated.asc
numbers() { grep -v '[a-zA-Z]' "$1" | tr -s ' ' '\n' | grep .; }
numbers heights.asc >ours
numbers translated.asc >theirs
yes same_heights sh -c \
    'paste ours theirs | awk "{ d = \$1 - \$2; if (d < -1e-3 || d > 1e-3) exit 1 } END { exit NR != 4225 }"'

check survey_file 0 gdal_translate -q -a_srs EPSG:2056 survey.asc survey.tif
check survey 0 "$RAMIFY" grow survey.yaml -o survey_land.tif --quiet
check survey_info 0 gdalinfo survey_land.tif
says survey_system out "CH1903+ / LV95"
# Its middle is 60 m to the east and 40 m to the north of the raster's, (2600400, 1200300).
says survey_origin out "Origin = (2600295.000000000000000,1200505.000000000000000)"
says survey_pixel out "Pixel Size = (10.000000000000000,-10.000000000000000)"
