#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Compiles shaders of the target msl with mslcheck.py. Arguments: mxgen, then documents, each with a role: ROLE=FILE.
mxgen=$(realpath "$1")
shift
here=$(cd "$(dirname "$0")" && pwd)
. "$here/../programs/common.sh"
clang=$(command -v clang)
{ [ -n "$clang" ] && /usr/bin/python3 -c 'import clang.cindex' 2>/dev/null; } || { skip 'without clang and python3-clang-14 no MSL is compiled'; exit 77; }

for document in "$@"; do
    role=${document%%=*} file=${document#*=}
    title=${file##*/}.$role
    check "$title is written" exits 0 "$mxgen" "$file" --target msl --role "$role" -q -o "$title.d" || continue
    for shader in "$title.d"/*.metal; do
        if [ "$role" = function ]; then # the host's struct of lights, above the function
            printf '#include <metal_stdlib>\nusing namespace metal;\nstruct MxgLights { int count() { return 0; } void light(int i, float3 P, thread float3& L, thread float3& radiance) { L = P; radiance = P; } };\n' |
                cat - "$shader" >"$shader.host.metal"
            shader=$shader.host.metal
        fi
        check "$shader" env MSL_TMP=. /usr/bin/python3 "$here/mslcheck.py" "$shader"
    done
done
# a mistake is found
printf '#include <metal_stdlib>\nusing namespace metal;\nfloat3 f(float2 v) { return v; }\n' >wrong.metal
check 'a wrong type is an error' exits 1 env MSL_TMP=. /usr/bin/python3 "$here/mslcheck.py" wrong.metal
finish msl
