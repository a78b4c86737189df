#!/bin/sh
# ramify measure of TreeQSM's cylinder tables.
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
here=$(cd "$(dirname "$0")" && pwd)
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
. "$here/checks.sh"

# A stem of two cylinders; at 1.5 m a branch at right angles, whose cylinder begins at the surface.
{
    printf '0.3\t1\t500000\t6e6\t100\t0\t0\t1\t0\t2\t1\t0\t1\t0\t0.3\n'
    printf '0.2\t1\t500000\t6e6\t101\t0\t0\t1\t1\t0\t1\t0\t2\t0\t0.2\n'
    printf '0.1\t0.8\t500000.2\t6e6\t101.5\t1\t0\t0\t2\t0\t2\t1\t1\t0\t0.1\n'
} >cyl_data_oak.txt

check table_is_measured 0 "$RAMIFY" measure cyl_data_oak.txt
matches kind out '^cyl_data_oak.txt (qsm)$'
matches height out '^  height  *2 m$'
matches width out '^  width  *1 m$'
matches length out '^  length  *3 m$'
matches terminals out '^  terminals  *2$'
matches root_radius out '^  root_radius  *0.3 m$'
matches branch_angle out '^  branch_angle  *90 degrees$'
matches tips out '^  tips  *2$'
matches diameter out '^  diameter  *0.48 m$'
cp cyl_data_oak.txt oak.qsm && tr '\t' ',' <oak.qsm >oak.csv
sed 1d out >table
for file in oak.qsm oak.csv; do
    check "${file}_is_measured" 0 "$RAMIFY" measure "$file"
    sed 1d out >other
    yes "${file}_measures_the_same" cmp table other
done
check json 0 "$RAMIFY" measure oak.qsm --json
says json_kind out '"kind": "qsm"'

sed '3s/\t2\t0\t2/\t4\t0\t2/' oak.qsm >astray.qsm
check missing_parent_is_refused 2 "$RAMIFY" measure astray.qsm
says missing_parent err 'astray.qsm:3:34: parent 4; the table has 3 cylinders'
echo "1 2 3" >short.txt
check short_row_is_refused 2 "$RAMIFY" measure short.txt
says short_row err 'short.txt:1:5: 3 numbers in the line; it must hold radius, length, start'
: >empty.csv
check empty_file_is_refused 2 "$RAMIFY" measure empty.csv
says empty_file err 'empty.csv: no cylinder in it'
check absent_file_is_refused 2 "$RAMIFY" measure none.qsm
says absent_file err 'none.qsm: cannot read it'
