#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The module that materials of MDL import (--mdl-module), compiled with them where mdlc is installed. Arguments: mxgen, and documents.
mxgen=$(realpath "$1")
shift
mapfile -d '' documents < <(realpath -z "$@")
. "$(dirname "$0")/../programs/common.sh"

# module FOLDER [OPTION...]
module() { exits 0 "$mxgen" pipeline "$1" --target mdl --mdl-module studio "${@:2}"; }

check 'the module is generated' module first
check 'is one file' [ "$(ls first)" = studio.mdl ]
check 'it has no material' eval '! grep -q "^export material" first/studio.mdl'
check 'its bytes are those of the library' eval 'module again --interface reduced --metadata none --colorspace acescg --reserved mx_bicubic && cmp first/studio.mdl again/studio.mdl'
check 'another name changes its title only' eval '"$mxgen" pipeline other --target mdl --mdl-module shared &&
    cmp <(sed "s/^\/\/ studio /\/\/ shared /" first/studio.mdl) other/shared.mdl'

cat >fit.glsl <<'END'
// Twenty terms.
float studio_series(float x)
{
    float sum = 0.0;
    for (int i = 0; i < 20; i++)
        sum += sin(x * float(i));
    return sum;
}
END
cat >library.mtlx <<'END'
<materialx version="1.39">
  <nodedef name="ND_series" node="series"><input name="x" type="float" value="1"/><output name="out" type="float"/></nodedef>
  <implementation name="IM_series" nodedef="ND_series" file="fit.glsl" function="studio_series"/>
</materialx>
END
cat >own.mtlx <<'END'
<materialx version="1.39">
  <texcoord name="uv" type="vector2"/>
  <dotproduct name="length" type="float"><input name="in1" type="vector2" nodename="uv"/><input name="in2" type="vector2" nodename="uv"/></dotproduct>
  <series name="waves" type="float"><input name="x" type="float" nodename="length"/></series>
  <output name="waving" type="float" nodename="waves"/>
</materialx>
END
check 'the module of a library' module more --library library.mtlx
check 'has the functions of the library' has more/studio.mdl '// Twenty terms.' 'export float studio_series(float x)'
check 'and those of the built-in one as they were' eval '[ -z "$(comm -23 <(sort first/studio.mdl) <(sort more/studio.mdl))" ]'
check 'a material of the library' exits 0 "$mxgen" own.mtlx --library library.mtlx --target mdl --mdl-module studio -o more
check 'calls the module' has more/waving.mdl 'import ::studio::*;' 'studio::studio_series('
sed -e '1r library.mtlx' own.mtlx | sed '2d; 5d' >whole.mtlx
check 'a definition of a document' exits 0 "$mxgen" whole.mtlx --target mdl --mdl-module studio --element waving -o local
check 'stays in the file' eval 'grep -q "^float studio_series(" local/waving.mdl && ! grep -q "import ::studio" local/waving.mdl'

# Documents of every family of surfaces, as modules with names of MDL, which need no file of MaterialX and none beside the module.
number=0
declare -A interfaces=([1.8]=complete [1.10]=reduced)
for version in 1.8 1.10; do
    mkdir "with$version"
    module "with$version" --target-version "$version"
    for document in "${documents[@]}"; do
        "$mxgen" "$document" --target mdl --target-version "$version" --mdl-module studio --interface "${interfaces[$version]}" --trust -q -o made >out 2>err
        ! grep -v 'mdl has no ' err | grep 'error: ' || check "$document" false
        for file in made/*.mdl; do mv "$file" "with$version/m$((++number)).mdl"; done
        rm -rf made
    done
done
check 'there are materials' [ "$number" -ge 80 ]
importing=$(grep -l '^import ::studio::' with*/m*.mdl | wc -l)
check 'most import the module' [ "$importing" -ge $((number / 2)) ]
check 'each that calls the module imports it, and no other' diff <(grep -l 'studio::m' with*/m*.mdl) <(grep -l '^import ::studio::' with*/m*.mdl)
sed -n 's/^export .* \(mx_[a-z0-9_]*\)(.*/\1/p' first/studio.mdl | sort >functions
check 'the module has functions' [ "$(wc -l <functions)" -ge 300 ]
check 'each has one name' [ -z "$(uniq -d functions)" ]
check 'no file has a copy of one' eval '! grep -hoE "^[a-z0-9_]+ mx_[a-z0-9_]+\(" with*/m*.mdl | sed "s/.* //; s/(//" | sort -u | comm -12 - functions | grep .'
if command -v mdlc >/dev/null; then
    for version in 1.8 1.10; do
        mapfile -t names < <(cd "with$version" && ls -- *.mdl | sed 's/^/::/; s/\.mdl$//')
        check "mdlc compiles the module and its materials, $version" exits 0 mdlc --no-resolve-resources -W 181=off -W 182=off -W 183=off -W 225=off -W 230=off \
            -W 350=off -p "with$version" "${names[@]}"
        check 'it says nothing' eval '! grep -h "Error\|Warning" out err'
    done
    check 'mxgen check knows the module' exits 0 "$mxgen" check own.mtlx --library library.mtlx --target mdl --mdl-module studio
    check 'it tells a module that is none' eval '! "$mxgen" check own.mtlx --library library.mtlx --target mdl --mdl-module df >out 2>&1 && grep -q bad-option out'
else
    skip 'mdlc is not installed: no module is compiled'
fi

for name in '' 'a b' 'a;b' 'a::b' '../a' 9a _a a__b gl_a mdl_a café color material df base std debug limits; do
    check "no module: '$name'" exits 1 "$mxgen" pipeline none --target mdl --mdl-module "$name"
    check 'the error says so' grep -qF "'$name' is not a value of option 'mdl-module'" err
done
check 'a hostile name in a material' exits 1 "$mxgen" own.mtlx --library library.mtlx --target mdl --mdl-module 'a;import ::b' -o none
check 'the error says so' grep -q "is not a value of option 'mdl-module'" err
check 'nothing was written' [ ! -e none/waving.mdl ]
check 'another target has no module' exits 2 "$mxgen" own.mtlx --library library.mtlx --target glsl --mdl-module studio -o none
check 'the error says so' grep -qF "'--mdl-module' does not apply to 'glsl'; it applies to 'mdl'" err
check 'a pipeline of another target' exits 2 "$mxgen" pipeline none --target vulkan --mdl-module studio
check 'a material in the place of the module' exits 1 "$mxgen" own.mtlx --library library.mtlx --target mdl --mdl-module waving -o none
check 'the error says so' grep -q "the element 'waving' and the module 'waving' would write one file" err

# Words of the document that are those of the module.
sed 's/"waves"/"studio"/g; s/"length"/"mx_fractal_float"/g' own.mtlx >clash.mtlx
check 'names of the module in a document' exits 0 "$mxgen" clash.mtlx --library library.mtlx --target mdl --mdl-module studio -o more
! command -v mdlc >/dev/null || check 'compile' mdlc --no-resolve-resources -W 183=off -p more ::waving
finish mdl-module
