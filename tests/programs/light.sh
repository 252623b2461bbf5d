# SPDX-License-Identifier: Apache-2.0
# The tests that measure the light of pictures source this file, which sources common.sh.
exr=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)/exr.py
. "$(dirname "$exr")/common.sh"

# near VALUE EXPECTED TOLERANCE
near() { awk -v a="$1" -v b="$2" -v t="$3" 'BEGIN { print a; exit !(a > b - t && a < b + t) }'; }
# of EXPRESSION: its value.
of() { awk "BEGIN { print $1 }"; }
# channel FILE NAME: its mean.
channel() { python3 "$exr" "$1" "$2" mean; }
# write_white FILE: an environment with the light 1 from everywhere, as Radiance's picture.
write_white() { { printf '#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n'; for _ in {1..32}; do printf '\200\200\200\201'; done; } >"$1"; }
