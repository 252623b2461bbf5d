#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A language's compiler accepts the shaders of all roles that the language has.
# Arguments: mxgen, mxgen-compile, the target, roles that it lacks ("deferred,depth"; none: ''), "all" or "roles", a part and the number of parts, and
# documents or folders of documents, of which the test takes this part. "roles" compiles them in other roles than raster, and nothing else.
mxgen=$(realpath "$1") compile=$(realpath "$2") target=$3 lacking=$4 kind=$5 part=$6 parts=$7
shift 7
mapfile -d '' all < <(realpath -z "$@" | xargs -0 -I{} find {} -name "*.mtlx" -print0 | sort -z)
documents=()
for i in "${!all[@]}"; do ((i % parts != part - 1)) || documents+=("${all[i]}"); done
has_folders=false
for path; do [ ! -d "$path" ] || has_folders=true; done
. "$(dirname "$0")/common.sh"

cat >gold.mtlx <<'END'
<materialx version="1.39">
  <standard_surface name="gold" type="surfaceshader"><input name="metalness" type="float" value="1"/></standard_surface>
</materialx>
END
# only_lacks: each error is of an element that the language cannot have. Documents of other people, in folders, also have faults of their own.
only_lacks() {
    if $has_folders; then
        ! grep '\[shader-invalid\]\|\[internal' err | grep .
    else
        ! grep '^error\|: error: ' err | grep -v "cannot be rendered: $target has no " | grep .
    fi
}

# compiles OPTION...: shaders are made, and the compiler refuses none.
compiles() {
    exits 0 "$compile" "$@" --targets "$target" || only_lacks || return
    [ -s out ] || { echo 'no shader was made' && return 1; }
    ! grep '^note: .* no compiler' err
}

for role in ${lacking//,/ }; do
    check "$role is an error" exits 1 "$mxgen" gold.mtlx --target "$target" --role "$role" -o none
    check "the error of $role has its reason" grep -q 'have no meaning together: only' err
done
"$compile" gold.mtlx --targets "$target" >out 2>err
if grep -q '^note: .* no compiler' err; then
    skip "no compiler for $target is installed: nothing is compiled"
    finish "$target"
fi
cat >coat.mtlx <<'END'
<materialx version="1.39">
  <slab name="metal" type="BSDF"><input name="f0" type="color3" value="0.9, 0.6, 0.3"/></slab>
  <slab name="varnish" type="BSDF"><input name="mean_free_path" type="vector3" value="0.2, 0.3, 0.4"/></slab>
  <slab_layer name="both" type="BSDF">
    <input name="top" type="BSDF" nodename="varnish"/><input name="base" type="BSDF" nodename="metal"/>
  </slab_layer>
  <surface name="coat" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="both"/></surface>
</materialx>
END
# roles WHAT ROLE... -- ARGUMENT...: those of the roles that the language has, in one process.
roles() {
    local what=$1 list=
    shift
    for (( ; $# > 0; )); do
        local role=$1
        shift
        [ "$role" != -- ] || break
        [[ ,$lacking, == *,$role,* ]] || list+=,$role
    done
    [ -z "$list" ] || check "$what, roles ${list#,}" compiles "$@" --roles "${list#,}"
}
if [ "$kind" = roles ]; then
    roles 'documents' path scatter function deferred depth payload -- "${documents[@]}" --trust --interfaces complete,reduced
    roles 'documents' pack -- "${documents[@]}" --trust --interfaces complete,reduced --slabs --transparency opaque
    finish "$target"
fi
check 'all documents compile' compiles "${documents[@]}" --trust --interfaces complete,reduced # the compiler starts once for all
balls=(gold.mtlx coat.mtlx)
roles 'shaders' path scatter function depth payload -- "${balls[@]}" --interfaces complete,reduced
roles 'slabs' deferred -- "${balls[@]}" --interfaces complete,reduced --slabs
roles 'slabs without holes' pack -- "${balls[@]}" --interfaces complete,reduced --slabs --transparency opaque
roles 'decals in images' payload -- "${balls[@]}" --interfaces reduced --decals images
roles 'decals in images on slabs' deferred pack -- "${balls[@]}" --interfaces reduced --decals images --slabs --transparency opaque
case $target in
    msl | wgsl | slang)
        roles 'half floats' raster function payload -- "${balls[@]}" --interfaces complete,reduced --precision mediump
        roles 'a host with lights' raster -- "${balls[@]}" --interfaces reduced --host-lights --host-occlusion --host-environment --host-thickness
        roles 'a host with shadows' raster -- "${balls[@]}" --interfaces reduced --host-shadows --environment none
        roles 'a host with an environment' function -- "${balls[@]}" --interfaces reduced --host-occlusion --host-environment
        ;;
esac
! $has_folders || roles 'documents' function deferred payload -- "${documents[@]}" --trust --interfaces reduced
finish "$target"
