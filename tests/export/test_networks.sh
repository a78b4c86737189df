#!/bin/sh
# Networks of vessels as files: .network.json and .vtp, checked by their own numbers. RAMIFY names the binary.
set -u
RAMIFY=$(realpath "${RAMIFY:-build/ramify}")
here=$(realpath "$(dirname "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
. "$here/../cli/checks.sh"

cat >organ.yaml <<'END'
objects:
  - {name: organ, vessels: {terminals: 200, envelope: [{shape: ellipsoid, size: [0.05, 0.03, 0.04]}]}}
  - {name: floor, ground: {grass_tufts: 0}}
  - {name: other, vessels: {terminals: 40, veins: false, envelope: [{shape: sphere, size: 0.02}]}}
END
check network_is_written 0 "$RAMIFY" export organ.yaml -o organ.network.json -q
check vtp_is_written 0 "$RAMIFY" export organ.yaml -o organ.vtp -q
yes networks_hold_what_flow_and_orders_say python3 "$here/network_check.py" organ.network.json organ.vtp
matches three_networks log '^3 networks'
check on_two_threads 0 "$RAMIFY" export organ.yaml -o again.network.json -q --threads 2
check on_one_thread 0 "$RAMIFY" export organ.yaml -o once.network.json -q --threads 1
yes threads_change_nothing cmp again.network.json once.network.json
# The flow keys of the object count; another object's default velocity is 0.2 m/s.
check faster 0 "$RAMIFY" export organ.yaml -o fast.network.json -q --set objects.other.vessels.flow.velocity=0.4
yes flow_follows_the_velocity python3 - <<'END'
import json
flow = lambda file, i: json.load(open(file))["networks"][i]["segments"][0]["flow"]
assert flow("fast.network.json", 0) == flow("organ.network.json", 0)
assert abs(flow("fast.network.json", 2) / flow("organ.network.json", 2) - 2) < 1e-6
END
printf 'objects: [{name: floor, ground: {grass_tufts: 0}}]\n' >bare.yaml
check nothing_grows 2 "$RAMIFY" export bare.yaml -o bare.vtp -q
says nothing_grows_says_so err "no object of 'bare.yaml' grows"
yes nothing_grows_writes_nothing [ ! -e bare.vtp ]

# The surface mesh: as fine as its vessels are thin, from the trunk to the ends.
cat >skin.yaml <<'END'
objects:
  - {name: organ, vessels: {terminals: 60, curve_radius: 1.0e-9, skin_levels: 1, envelope: [{shape: ellipsoid, size: [0.05, 0.03, 0.04]}]}}
END
check skin_is_written 0 "$RAMIFY" export skin.yaml -o skin.ply -q
yes edges_follow_the_radius python3 "$here/edge_check.py" skin.ply
fine=$(cat log)
check coarser_skin 0 "$RAMIFY" export skin.yaml -o skin.ply -q --set objects.organ.vessels.ring_spacing=2
python3 "$here/edge_check.py" skin.ply >coarse
yes rings_are_further_apart [ "$(cat coarse)" -lt "$((fine * 3 / 4))" ]
