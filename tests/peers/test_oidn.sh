#!/bin/sh
# Denoising by the real Open Image Denoise (`make peers` installs it): nearer to the converged picture than the noisy one and
# than ramify's own denoiser. RAMIFY names the binary, RAMIFY_PEERS where the peers are. Prints "ok NAME", "not ok NAME" or
# "skipped NAME: why".
tests=$(cd "$(dirname "$0")/.." && pwd)
. "$tests/cli/checks.sh"
RAMIFY=${RAMIFY:-build/ramify}
case $RAMIFY in /*) ;; *) RAMIFY=$PWD/$RAMIFY ;; esac
library=$(ls "${RAMIFY_PEERS:-$PWD/build/peers}"/python/lib/python*/site-packages/pyoidn/oidn/lib/libOpenImageDenoise.so.2 2>/dev/null)
if [ ! -e "$library" ]; then
    echo "skipped oidn: pyoidn is not installed"
    exit 0
fi
folder=$(mktemp -d) && trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1

shoot() { # shoot FILE ARGUMENT...: of other noise than the converged picture's
    file=$1
    shift
    RAMIFY_OIDN=$library "$RAMIFY" render "$tests/golden/bodies.yaml" -q -o "$file" --isa sse4.2 --size 96x72 "$@"
}
rmse() { # rmse FILE: from the converged picture
    "$RAMIFY" compare "$1" converged.png --json | sed -n 's/.*"rmse": *\([0-9.e-]*\).*/\1/p'
}
check converged 0 shoot converged.png --samples 512
noisy="--samples 16 --set render.noise_seed=9"
check raw 0 shoot raw.png $noisy
check own 0 shoot own.png $noisy --denoise
check oidn 0 shoot oidn.png $noisy --denoise --set film.denoiser=oidn
check one_thread 0 shoot one.png $noisy --denoise --set film.denoiser=oidn --threads 1
yes threads_change_nothing "$RAMIFY" compare oidn.png one.png --max-rmse 0.001
raw=$(rmse raw.png) own=$(rmse own.png) oidn=$(rmse oidn.png)
echo "   rmse: raw $raw, own $own, oidn $oidn"
yes nearer_than_raw awk "BEGIN { exit !($oidn > 0 && $oidn < 0.5 * $raw) }"
yes nearer_than_own awk "BEGIN { exit !($oidn > 0 && $oidn < $own) }"
