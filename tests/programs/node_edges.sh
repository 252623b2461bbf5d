#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Nodes at the edges of their inputs, where no row of tests/conformance is: the values are those of MaterialX's own graphs and code.
# Arguments: the program.
mxgen=$(realpath "$1")
. "$(dirname "$(realpath "$0")")/common.sh"

# edge NODE TYPE VALUE INPUT=TYPE:VALUE…: the node has this value with these inputs
edge() {
    local node=$1 type=$2 value=$3 inputs='' constants='' input name of
    shift 3
    for input; do
        name=${input%%=*} of=${input#*=}
        constants+="<constant name=\"$name\" type=\"${of%%:*}\"><input name=\"value\" type=\"${of%%:*}\" value=\"${of#*:}\"/></constant>"
        inputs+="<input name=\"$name\" type=\"${of%%:*}\" nodename=\"$name\"/>"
    done
    echo "<materialx version=\"1.39\">$constants<$node name=\"n\" type=\"$type\">$inputs</$node><output name=\"o\" type=\"$type\" nodename=\"n\"/></materialx>" >edge.mtlx
    check "$node of $* is $value" eval '"$mxgen" inspect --ir edge.mtlx -e o --interface reduced >ir && [ "$(cat ir)" = "return $value" ]'
}

# Circles about points at the radius to both sides: its sign is none of the shape.
edge cloverleaf float 1.0 texcoord=vector2:0.1,0.05 radius=float:0.5
edge cloverleaf float 1.0 texcoord=vector2:0.1,0.05 radius=float:-0.5
edge circle float 1.0 texcoord=vector2:0.1,0.05 radius=float:-0.5
# A line without length is a disk.
edge line float 0.0 texcoord=vector2:0.9,0.9 center=vector2:0,0 radius=float:0.1 point1=vector2:0.25,0.25 point2=vector2:0.25,0.25
edge line float 1.0 texcoord=vector2:0.3,0.3 center=vector2:0,0 radius=float:0.1 point1=vector2:0.25,0.25 point2=vector2:0.25,0.25

finish node-edges
