#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The examples in Python. Arguments: Python, the root of the project, a folder with the package, the examples in C.
python=$1 root=$2
export PYTHONPATH=$3
shift 3
for program in "$@"; do
    [ "$(basename "$program")" != edit ] || edit=$(realpath "$program")
done
. "$(dirname "$0")/../programs/common.sh"

check "the example edit.py runs" exits 0 "$python" "$root/examples/edit.py"
mv out python.mtlx
check "the example edit.c runs" exits 0 env -u LD_PRELOAD "$edit"
check "edit.py writes what edit.c writes" cmp python.mtlx out
check "the example shader.py runs" exits 0 "$python" "$root/examples/shader.py" "$root/examples/marble.mtlx" glsl
check "shader.py writes a shader" grep -q '^void main' out
check "shader.py lists uniforms" grep -q '^// NG_marble/stone: vec3 ' out
check "shader.py fails without a document" exits 1 "$python" "$root/examples/shader.py" none.mtlx glsl
check "shader.py reports errors" grep -q 'error: .*file-missing' err
check "shader.py prints no trace" exits 1 grep Traceback err
mkdir stacks
check "the example scene.py runs" exits 0 "$python" "$root/examples/scene.py" "$root/examples/slots/looks.mtlx" finished "$root/examples/slots/receiver.usda" stacks
check "scene.py lists the layers" grep -q '^/receiver/keys stack_[0-9a-f]* 000 generic, 000::010 generic_pattern, 000|010 varnish, ' out
check "scene.py writes a shader for each stack" test "$(grep -o 'stack_[0-9a-f]*' out | sort -u)" = "$(ls stacks | sed 's/.frag//')"
check "scene.py fails without a look" exits 1 "$python" "$root/examples/scene.py" "$root/examples/slots/looks.mtlx" none "$root/examples/slots/receiver.usda" stacks
finish python-examples
