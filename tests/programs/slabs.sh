#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# slabs.sh MXGEN COMPILE EXAMPLES: budgets of slabs, profiles, `--slabs` and `inspect --slabs`, as a user calls them.
mxgen=$(realpath "$1") compile=${2:+$(realpath "$2")} examples=$(realpath "$3")
. "$(dirname "$0")/common.sh"
slabs=$examples/slabs.mtlx

says() { grep -qF -- "$1" err; }
compiles() { # document and options of generation: all its materials, for two languages
    [ -z "$compile" ] || exits 0 "$compile" "$@" --targets vulkan,hlsl
}

# Budgets
for closures in 1 2 3; do
    check "materials with $closures slabs compile" compiles "$slabs" --max-slabs "$closures"
done
check 'a budget prints nothing' eval 'exits 0 "$mxgen" "$slabs" -e CarPaint --max-slabs 1 -o made && test ! -s err'
check '-Wbudget-step is accepted' exits 0 "$mxgen" "$slabs" -e CarPaint --max-slabs 1 -Wbudget-step -o made
check 'a feature can be left out' exits 0 "$mxgen" "$examples/slab_blends.mtlx" -e Opal --features -roughness-tracking -o quiet
check 'a feature can be left out with a message' exits 0 "$mxgen" "$examples/slab_blends.mtlx" -e Opal --features -roughness-tracking -Wbudget-step -o told
check 'the message does not change the shader' eval 'says "no roughness of what lies below" && cmp -s quiet/Opal.frag told/Opal.frag'
check 'a budget of one closure takes steps' exits 0 "$mxgen" "$slabs" -e CarPaint --max-slabs 1 -Wbudget-step -o made
check 'the mix is blended first' eval 'grep -F budget-step err | head -1 | grep -qE "the mix .paint.: slabs 3 to 2, bytes 40 to 28, estimated error 0\.[0-9]+ "'
check 'the layer is blended last' eval 'grep -F budget-step err | tail -1 | grep -qE "the layer .coated.: slabs 2 to 1, bytes 28 to 16"'
check '--max-steps 1 is accepted' exits 0 "$mxgen" "$slabs" -e CarPaint --max-slabs 1 --max-steps 1 -Wbudget-step -o made
check '--max-steps 1 takes one step, whatever the budget' eval '[ "$(grep -cF budget-step err)" = 1 ] && says "the mix" && ! says "the layer"'
check 'inspect takes a budget' exits 0 "$mxgen" inspect "$slabs" -e CarPaint --slabs --max-bytes 12
check 'inspect shows the steps to its budget' eval 'grep -q "^to the budget" out && grep -q "no second lobe: slabs 1 to 1, bytes 16 to 12" out'
check 'a budget of bytes is accepted' exits 0 "$mxgen" "$slabs" -e CarPaint --max-bytes 12 -Wbudget-step -o made
check 'a budget of bytes leaves out the second lobe' says 'no second lobe: slabs 1 to 1, bytes 16 to 12'
check 'a budget of an error is accepted' exits 0 "$mxgen" "$slabs" -e CarPaint --max-error 0.2 -Wbudget-step -o made
check 'a small error keeps the coat' eval 'says "the mix" && ! says "the layer"'
check 'inspect says what the least is' eval '"$mxgen" inspect "$slabs" -e CarPaint --slabs --max-bytes 8 >out && grep -q "nothing keeps to the budget; the least are 1 slabs, 12 bytes" out'
check 'too few bytes fail' exits 1 "$mxgen" "$slabs" -e CarPaint --max-bytes 8 -o made
check 'the error is budget-impossible' says '[budget-impossible]'
check 'one slab within a small error fails' exits 1 "$mxgen" "$slabs" -e CarPaint --max-slabs 1 --max-error 0.01 -o made
check 'the error names both limits' says '1 slab, an error of 0.01'
check 'a limit that is no number is wrong usage' exits 2 "$mxgen" "$slabs" --max-error much -o made
check 'the error gives the range' says "expected a number of 0..100"

check 'a budget of bytes takes steps for operators' exits 0 "$mxgen" "$slabs" -e DustyFibre --max-slabs 1 --max-error 1.98 -Wbudget-step -o made
check 'operators blend before features go' eval '[ "$(grep -cF budget-step err)" = 2 ] && says "bytes 48 to 24"'
check 'glints can be left out' exits 0 "$mxgen" "$examples/slab_glints.mtlx" -e FlakePaint --features -glints -Wbudget-step -o made
check 'the error of lost glints is unknown' says 'no glints: slabs 2 to 2, bytes 40 to 24, estimated error unknown'
check 'a large error is accepted' exits 0 "$mxgen" "$examples/slab_glints.mtlx" -e FlakePaint --max-error 50 -Wbudget-step -o made
check '--max-error keeps glints' eval '! says "no glints"'

# Features
check 'an unknown feature is wrong usage' exits 2 "$mxgen" "$slabs" --features -glimmer -o made
check 'the error lists the features' says "-glints, -lut, -fuzz"
sed 's/<slab name="dust" type="BSDF">/&<input name="glint_density" type="float" value="3"\/>/; s/value="0, 0, 0"/value="0.04, 0.04, 0.04"/' "$slabs" >glints.mtlx
check 'a shader with glints compiles' compiles glints.mtlx
check 'a shader without glints is generated' exits 0 "$mxgen" glints.mtlx -e DustyFibre --features -glints --stdout
check 'a shader without glints has no code of them' eval '! grep -q mx_glints out'
check 'glints give a shader of OSL' exits 0 "$mxgen" glints.mtlx -e DustyFibre --target osl --stdout
check 'OSL has a facet for each point and the light that it mirrors' eval 'test ! -s err && ! grep -q hashnoise out && grep -q "= mx_slab_facet(" out && grep -q "= mx_slab_facet_light(" out'
check 'slabs without glints give a shader of OSL' exits 0 "$mxgen" "$slabs" -e DustyFibre --target osl --stdout
check 'OSL has no facet without glints' eval '! grep -q slab_facet out'
check 'a tint gives a shader of OSL' exits 0 "$mxgen" "$examples/slab_glints.mtlx" -e PearlPaint --features -glints --target osl --stdout
check 'OSL draws the facet of a tint by the point' eval 'test ! -s err && grep -q "hashnoise(P, time)" out && ! grep -q glint_facet out'
check 'threads give a shader of OSL' exits 0 "$mxgen" "$slabs" -e WrappedSilk --target osl --stdout
check 'OSL adds vectors as vectors, not as colours' eval 'grep -qF "vector weft_reflection_ggx_compensation = " out && ! grep -qF "color weft_reflection_ggx_compensation" out'
check 'a clear body gives a shader of OSL' exits 0 "$mxgen" "$examples/slab_bodies.mtlx" -e Amber --target osl --stdout
check 'OSL lets light through a body in its colour, without total reflection from behind' eval 'grep -q "transparent_bsdf()" out && ! grep -q "vector(0.33333334)" out && grep -q "float(backfacing_)" out'
cat >regimes.mtlx <<'END'
<materialx version="1.39">
  <image name="picture" type="color3"><input name="file" type="filename" value="skin.png"/></image>
  <noise2d name="mask" type="float"/>
  <constant name="host" type="color3"><input name="value" type="color3" value="0, 0, 0"/></constant>
  <slab name="textured" type="BSDF">
    <input name="diffuse_albedo" type="color3" nodename="picture"/><input name="mean_free_path" type="vector3" value="0.3, 0.1, 0.05"/>
  </slab>
  <slab name="pale" type="BSDF">
    <input name="diffuse_albedo" type="color3" value="0.8, 0.6, 0.5"/><input name="mean_free_path" type="vector3" value="0.3, 0.1, 0.05"/>
  </slab>
  <slab name="mud" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.2, 0.1, 0"/></slab>
  <slab name="glass" type="BSDF">
    <input name="diffuse_albedo" type="color3" nodename="host"/><input name="mean_free_path" type="vector3" value="0.3, 0.1, 0.05"/>
  </slab>
  <slab_mix name="muddy" type="BSDF">
    <input name="fg" type="BSDF" nodename="mud"/><input name="bg" type="BSDF" nodename="pale"/><input name="mix" type="float" nodename="mask"/>
  </slab_mix>
  <slab_layer name="coated" type="BSDF">
    <input name="top" type="BSDF" nodename="glass"/><input name="base" type="BSDF" nodename="pale"/><input name="thickness" type="float" value="0.1"/>
  </slab_layer>
  <slab_surface name="Textured" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="textured"/></slab_surface>
  <slab_surface name="Muddy" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="muddy"/></slab_surface>
  <slab_surface name="Coated" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="coated"/></slab_surface>
  <slab_surface name="Glass" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="glass"/></slab_surface>
</materialx>
END
for budget in '' '--max-slabs 1'; do
    for name in Textured Muddy Coated; do
        check "$name is stored ${budget:-without a budget}" exits 0 "$mxgen" regimes.mtlx -e $name --role deferred --target vulkan --interface reduced $budget -o made
        check "$name is opaque ${budget:-without a budget}" eval '! grep -q drawn-forward out err && grep -q mx_word0 made/$name.frag'
    done
done
check 'a clear body is no matter for pixels' exits 0 "$mxgen" regimes.mtlx -e Glass --role deferred --target vulkan -o made
check 'it is drawn forward' grep -q drawn-forward err
check 'glints are stored' exits 0 "$mxgen" glints.mtlx -e DustyFibre --role deferred --target vulkan -o made
check 'stored glints are lit by a pass' eval 'grep -q mx_word0 made/DustyFibre.frag && ! grep -q drawn-forward out err'
check 'fuzz can be left out' exits 0 "$mxgen" inspect --closures "$slabs" -e DustyFibre --features -fuzz
check 'there is no sheen without fuzz' eval '! grep -q mx_sheen out'

# Payloads, and path tracers of surfaces without light
check 'payloads of slabs compile' eval '[ -z "$compile" ] || exits 0 "$compile" "$slabs" --role payload --targets vulkan,glsl'
echo '<materialx version="1.39"><surface name="Black" type="surfaceshader"/></materialx>' >black.mtlx
check 'a black surface is traced' exits 0 "$mxgen" black.mtlx --role scatter --stdout
# A volume behind glass has no place behind a slab
cat >filled.mtlx <<'END'
<materialx version="1.39">
  <dielectric_bsdf name="glass" type="BSDF"><input name="scatter_mode" type="string" value="RT"/></dielectric_bsdf>
  <anisotropic_vdf name="smoke" type="VDF"><input name="absorption" type="vector3" value="1, 0.2, 0.1"/></anisotropic_vdf>
  <layer name="filled" type="BSDF"><input name="top" type="BSDF" nodename="glass"/><input name="base" type="VDF" nodename="smoke"/></layer>
  <slab name="red" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.8, 0.1, 0.1"/></slab>
  <mix name="both" type="BSDF"><input name="fg" type="BSDF" nodename="red"/><input name="bg" type="BSDF" nodename="filled"/><input name="mix" type="float" value="0.4"/></mix>
  <surface name="Filled" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="both"/></surface>
  <slab_coverage name="nothing" type="BSDF"><input name="in" type="BSDF" nodename="red"/><input name="weight" type="float" value="0"/></slab_coverage>
  <layer name="hollow" type="BSDF"><input name="top" type="BSDF" nodename="nothing"/><input name="base" type="VDF" nodename="smoke"/></layer>
  <surface name="Hollow" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="hollow"/></surface>
</materialx>
END
check 'glass with a volume beside a slab becomes one slab' exits 0 "$mxgen" inspect --slabs filled.mtlx -e Filled --max-slabs 1
check 'the mix of both becomes one slab in a step of its own' grep -q "one slab for the mix 'both': slabs 2 to 1" out
check 'a volume behind nothing is generated' exits 0 "$mxgen" filled.mtlx -e Hollow --target vulkan --stdout

# A sum of a sum with itself, and so on: 2^40 ways from the surface to a closure.
{
    printf '<materialx version="1.39"><dielectric_bsdf name="x0" type="BSDF"/>'
    for i in {0..39}; do
        printf '<add name="x%d" type="BSDF"><input name="in1" type="BSDF" nodename="x%d"/><input name="in2" type="BSDF" nodename="x%d"/></add>' $((i + 1)) "$i" "$i"
    done
    printf '<slab name="milk" type="BSDF"><input name="mean_free_path" type="vector3" value="0.1, 0.1, 0.1"/></slab>'
    printf '<slab_layer name="all" type="BSDF"><input name="top" type="BSDF" nodename="milk"/><input name="base" type="BSDF" nodename="x40"/></slab_layer>'
    printf '<surface name="S" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="all"/></surface></materialx>\n'
} >shared.mtlx
check 'a tree of shared closures ends in time' exits 0 timeout 20 "$mxgen" shared.mtlx --target vulkan --role scatter --stdout
check 'the error says that the tree is too large' grep -q 'its tree is too large' err
check 'no shader divides by 0' eval '! grep -q "[^/]/ 0\.0" out'

# Media over media: a weight is a coverage
cat >half.mtlx <<'END'
<materialx version="1.39">
  <oren_nayar_diffuse_bsdf name="red" type="BSDF"><input name="weight" type="float" value="0.5"/>
    <input name="color" type="color3" value="0.8, 0.1, 0.1"/></oren_nayar_diffuse_bsdf>
  <oren_nayar_diffuse_bsdf name="blue" type="BSDF"><input name="color" type="color3" value="0.1, 0.1, 0.8"/></oren_nayar_diffuse_bsdf>
  <layer name="both" type="BSDF"><input name="top" type="BSDF" nodename="red"/><input name="base" type="BSDF" nodename="blue"/></layer>
  <surface name="Half" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="both"/></surface>
  <dielectric_bsdf name="pane" type="BSDF"/>
  <surface name="Pane" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="pane"/></surface>
</materialx>
END
check 'half a medium over another one is generated' exits 0 "$mxgen" half.mtlx -e Half --slabs -Wbudget-step --stdout
check 'half a medium over another one has a small error' eval 'grep -qE "closures become slabs.*estimated error 0\.[0-2]" err'
check 'an interface over nothing is generated' exits 0 "$mxgen" half.mtlx -e Pane --slabs -Wbudget-step --stdout
check 'an interface over nothing has a small error' eval 'grep -qE "closures become slabs.*estimated error [01]\." err'

# Roughness tracking: a mirror lobe of width 0.04 below an interface of width 0.25, by Belcour's formulas
layered() { # f0 and mean free path of the top
    cat >layered.mtlx <<END
<materialx version="1.39">
  <slab name="metal" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="f0" type="color3" value="0.9, 0.6, 0.3"/>
    <input name="roughness" type="float" value="0.2"/></slab>
  <slab name="coat" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="f0" type="color3" value="$1"/>
    <input name="roughness" type="float" value="0.5"/><input name="mean_free_path" type="vector3" value="$2"/></slab>
  <slab_coverage name="half" type="BSDF"><input name="in" type="BSDF" nodename="coat"/><input name="weight" type="float" value="0.5"/></slab_coverage>
  <slab_layer name="coated" type="BSDF"><input name="top" type="BSDF" nodename="${3:-coat}"/><input name="base" type="BSDF" nodename="metal"/></slab_layer>
  <slab_surface name="out" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="coated"/></slab_surface>
</materialx>
END
}
width() { # the share of the spread: the width that the metal has
    python3 -c 'import sys
v = lambda alpha: alpha ** 1.1 / (1 - alpha ** 1.1)
total = v(0.04) + float(sys.argv[1]) * (v(0.25 / 6) + v(0.25 / 4))
print(f"{(total / (1 + total)) ** (1 / 1.1):.5f}"[:6])' "$1"
}
layered '0.04, 0.04, 0.04' '1, 1, 1'
check 'a coated metal is generated' exits 0 "$mxgen" layered.mtlx --interface reduced --stdout
check 'a coat widens the lobe of the metal' grep -qF "mx_ggx_albedo_fit($(width 1)" out
check 'a coated metal is generated without roughness tracking' exits 0 "$mxgen" layered.mtlx --interface reduced --features -roughness-tracking --stdout
check 'the lobe keeps its width without roughness tracking' grep -qF 'mx_ggx_albedo_fit(0.04,' out
layered '0.01, 0.01, 0.01' '1, 1, 1'
check 'a faint interface is generated' exits 0 "$mxgen" layered.mtlx --interface reduced --stdout
check 'a faint interface widens the lobe by half' grep -qF "mx_ggx_albedo_fit($(width 0.5)" out
layered '0.04, 0.04, 0.04' '1, 1, 1' half
check 'half a coat is generated' exits 0 "$mxgen" layered.mtlx --interface reduced --stdout
check 'half a coat widens the lobe by half' grep -qF "mx_ggx_albedo_fit($(width 0.5)" out
layered '0.04, 0.04, 0.04' '0, 0, 0' half
check 'an opaque coat is generated' exits 0 "$mxgen" layered.mtlx --interface reduced --stdout
check 'an opaque coat does not widen the lobe' grep -qF 'mx_ggx_albedo_fit(0.04,' out

# The document asks for one slab
sed 's/<input name="mix" type="float" value="0.6"\/>/&<input name="blend_parameters" type="boolean" value="true"\/>/' "$slabs" >asked.mtlx
check 'a document may ask for one slab' exits 0 "$mxgen" asked.mtlx -e CarPaint -Wbudget-step -o made
check 'the document gets one slab' says "one slab for 'paint': slabs 3 to 2"
check '--max-steps 0 is accepted' exits 0 "$mxgen" asked.mtlx -e CarPaint --max-steps 0 -Wbudget-step -o made
check '--max-steps 0 leaves out the step of the document' eval '! says "one slab"'
mixes() { # two mixes of the same slabs, and a mix of these; the first ARGUMENT of them ask
    python3 - "$1" <<'END'
import sys
ask = lambda i: '<input name="blend_parameters" type="boolean" value="true"/>' if i < int(sys.argv[1]) else ""
mixes = "".join(f"""<slab_mix name="{name}" type="BSDF"><input name="fg" type="BSDF" nodename="{fg}"/><input name="bg" type="BSDF" nodename="{bg}"/>
  <input name="mix" type="float" value="0.{i + 2}"/>{ask(i)}</slab_mix>""" for i, (name, fg, bg) in enumerate((("p", "a", "b"), ("q", "a", "b"), ("r", "p", "q"))))
print(f"""<materialx version="1.39"><slab name="a" type="BSDF"/><slab name="b" type="BSDF"><input name="roughness" type="float" value="0.2"/></slab>
  {mixes}<slab_surface name="out" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="r"/></slab_surface></materialx>""")
END
}
mixes 3 >mixes.mtlx
check 'mixes that share slabs may ask for one slab' exits 0 "$mxgen" mixes.mtlx -Wbudget-step -o made
check 'mixes that share slabs blend together' eval '[ "$(grep -cF budget-step err)" = 1 ] && says "slabs 2 to 1, bytes 36 to 16" && ! says not-blended'
mixes 1 >mixes.mtlx
check 'one of two mixes that share slabs may ask for one slab' exits 0 "$mxgen" mixes.mtlx -Wbudget-step -o made
check 'one of two mixes that share slabs does not blend' eval "says \"the parameters of 'p' do not blend\" && ! says budget-step"

# Sums and products
cat >sum.mtlx <<'END'
<materialx version="1.39">
  <slab name="a" type="BSDF"/>
  <slab name="b" type="BSDF"><input name="roughness" type="float" value="0.2"/></slab>
  <multiply name="half" type="BSDF"><input name="in1" type="BSDF" nodename="a"/><input name="in2" type="color3" value="0.5, 0.2, 0.1"/></multiply>
  <add name="both" type="BSDF"><input name="in1" type="BSDF" nodename="half"/><input name="in2" type="BSDF" nodename="b"/></add>
  <slab_surface name="out" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="both"/></slab_surface>
</materialx>
END
check 'a sum takes a budget' exits 0 "$mxgen" sum.mtlx --max-slabs 1 -Wbudget-step -o made
check 'a sum becomes one slab' says "one slab for the sum 'both': slabs 2 to 1"

# Profiles
for profile in desktop console mobile one-slab; do
    check "the profile $profile compiles" compiles "$slabs" --profile "$profile"
done
check 'an unknown profile is wrong usage' exits 2 "$mxgen" "$slabs" --profile mobil -o made
check 'an unknown profile has a suggestion' says "did you mean 'mobile'"
printf '# ours\nmax-slabs = 2 # as the others\nfeatures = ["-fuzz", "-f90"]\n' >own.toml
check 'a profile may be a file' exits 0 "$mxgen" "$slabs" -e DustyFibre --profile own.toml -Wbudget-step -o made
check 'the options of the file count' eval 'says "no fuzz" && says "slabs 3 to 2"'
check 'the command line goes with a profile' exits 0 "$mxgen" "$slabs" -e DustyFibre --profile own.toml --max-slabs 1 -Wbudget-step -o made
check 'the command line replaces an option of the profile' says 'slabs 2 to 1'
printf 'max-slabs = 2\nmax-byts = 3\n' >wrong.toml
check 'an unknown key of a profile is wrong usage' exits 2 "$mxgen" "$slabs" --profile wrong.toml -o made
check 'the error has the line of the key' says "wrong.toml:2: error: unknown option 'max-byts' (did you mean 'max-bytes'?)"
printf 'max-slabs 2\n' >wrong.toml
check 'a line without a value is wrong usage' exits 2 "$mxgen" "$slabs" --profile wrong.toml -o made
check 'the error says what a line is' says 'wrong.toml:1: error: a line is a comment'
check 'a profile that is missing is wrong usage' exits 2 "$mxgen" "$slabs" --profile gone.toml -o made
check 'the error names the file of the profile' says "cannot read the profile 'gone.toml'"

# Below a medium that scatters, metal mirrors a part of the light and sends the rest back evenly.
cat >milky.mtlx <<'END'
<materialx version="1.39">
  <slab name="milk" type="BSDF"><input name="diffuse_albedo" type="color3" value="0.9, 0.9, 0.9"/><input name="mean_free_path" type="vector3" value="1, 1, 1"/></slab>
  <slab name="amber" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="mean_free_path" type="vector3" value="1, 1, 1"/></slab>
  <slab name="metal" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="f0" type="color3" value="0.8, 0.8, 0.8"/></slab>
  <slab_layer name="in_amber" type="BSDF"><input name="top" type="BSDF" nodename="amber"/><input name="base" type="BSDF" nodename="metal"/><input name="thickness" type="float" value="0.5"/></slab_layer>
  <slab_layer name="in_milk" type="BSDF"><input name="top" type="BSDF" nodename="milk"/><input name="base" type="BSDF" nodename="metal"/><input name="thickness" type="float" value="0.5"/></slab_layer>
  <slab_layer name="in_both" type="BSDF"><input name="top" type="BSDF" nodename="amber"/><input name="base" type="BSDF" nodename="in_milk"/></slab_layer>
  <slab_layer name="both" type="BSDF"><input name="top" type="BSDF" nodename="milk"/><input name="base" type="BSDF" nodename="amber"/><input name="thickness" type="float" value="0.5"/></slab_layer>
  <slab_layer name="below_both" type="BSDF"><input name="top" type="BSDF" nodename="both"/><input name="base" type="BSDF" nodename="metal"/></slab_layer>
  <slab_surface name="InAmber" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="in_amber"/></slab_surface>
  <slab_surface name="InMilk" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="in_milk"/></slab_surface>
  <slab_surface name="InBoth" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="in_both"/></slab_surface>
  <slab_surface name="BelowBoth" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="below_both"/></slab_surface>
</materialx>
END
metal() { # element, options: the line that stores its metal, the lowest slab
    "$mxgen" milky.mtlx -e "$1" --interface reduced --role deferred --target vulkan "${@:2}" --stdout | grep -F 'stored = mx_store_closure(' | tail -1
}
# scattering of albedo 0.9 over half a free path: 0.499; straight: exp(-2.292 0.499) (1 + 0.374) (1 + 0.374 0.2) = 0.471; 0.8 0.529 / (1 - 0.8 0.471)
evened='vec3(0.679'
check 'metal below a clear medium mirrors all light' eval '[ "$(metal InAmber | grep -cF "vec3(0.0), vec3(0.8)")" = 1 ]'
check 'metal below milk has a diffuse albedo' eval 'metal InMilk | grep -qF "$evened"'
check 'a clear coat above the milk changes nothing' eval 'metal InBoth | grep -qF "$evened"'
check 'a layer in the top of another keeps its thickness' eval 'metal BelowBoth | grep -qF "$evened"'
check 'without roughness tracking metal below milk mirrors all light' eval 'metal InMilk --features -roughness-tracking | grep -qF "vec3(0.0), vec3(0.8)"'

# Other materials
for document in marble gold car_paint; do
    check "$document.mtlx compiles as slabs" compiles "$examples/$document.mtlx" --slabs
    check "$document.mtlx compiles as one slab" compiles "$examples/$document.mtlx" --max-slabs 1
done
check 'marble takes a budget of one closure' exits 0 "$mxgen" inspect --closures "$examples/marble.mtlx" --max-slabs 1
check 'marble has lobes of slabs only' eval 'grep -q mx_slab_medium_bsdf out && ! grep -qE "mx_(oren|dielectric|conductor)" out'

cat >glass.mtlx <<'END'
<materialx version="1.39">
  <dielectric_bsdf name="glass" type="BSDF"><input name="roughness" type="vector2" value="0.36, 0.36"/>
    <input name="scatter_mode" type="string" value="RT"/></dielectric_bsdf>
  <surface name="out" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="glass"/></surface>
</materialx>
END
check 'glass takes a budget of one closure' exits 0 "$mxgen" glass.mtlx --max-slabs 1 --interface reduced --stdout
check 'glass as one slab has the mean roughness' grep -qF "$(python3 -c 'import math
g = math.log2(2 / 0.6 ** 4 - 1) / 18 # the bump of Chan 2018
print(f"+ {(34.5 * g - 59) * g + 24.5:.3f}"[:-1])')" out

cat >painted.mtlx <<'END'
<?xml version="1.0"?>
<materialx version="1.39">
  <dielectric_bsdf name="gloss" type="BSDF"/>
  <oren_nayar_diffuse_bsdf name="paint" type="BSDF"/>
  <layer name="painted" type="BSDF"><input name="top" type="BSDF" nodename="gloss"/><input name="base" type="BSDF" nodename="paint"/></layer>
  <surface name="Painted" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="painted"/></surface>
</materialx>
END
check 'an interface over a medium is inspected' exits 0 "$mxgen" inspect --slabs painted.mtlx
check 'an interface over a medium is one slab' grep -q '1 slab' out

check 'marble is generated as slabs' exits 0 "$mxgen" "$examples/marble.mtlx" --slabs --interface reduced -o made
check 'the light of the environment is added once' eval '! sed -n "/int i = 0; i < /,/^    }/p" made/Marble.frag | grep -E "medium|u_envIrradiance"'

# Chances
cat >covered.mtlx <<'END'
<materialx version="1.39">
  <slab name="milk" type="BSDF"><input name="mean_free_path" type="vector3" value="0.1, 0.1, 0.1"/></slab>
  <slab name="tar" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/></slab>
  <slab_mix name="both" type="BSDF"><input name="fg" type="BSDF" nodename="milk"/><input name="bg" type="BSDF" nodename="tar"/>
    <input name="mix" type="float" value="0.5"/></slab_mix>
  <slab_coverage name="covered" type="BSDF"><input name="in" type="BSDF" nodename="both"/><input name="weight" type="float" value="1"/></slab_coverage>
  <slab_layer name="layered" type="BSDF"><input name="top" type="BSDF" nodename="covered"/><input name="base" type="BSDF" nodename="milk"/></slab_layer>
  <slab_surface name="out" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="layered"/></slab_surface>
</materialx>
END
sed 's/"weight" type="float" value="1"/"weight" type="float" value="2"/' covered.mtlx >double.mtlx
for name in covered double; do
  check "a path through $name is generated" eval "exits 0 '$mxgen' $name.mtlx --role scatter --interface reduced --stdout && cp out $name.frag"
done
check 'a weight above 1 counts as 1' eval 'grep -q "matter.y >= 0.5" covered.frag && grep -q "matter.y >= 0.5" double.frag'

# Views
check 'a sheet is inspected for the deferred pipeline' exits 0 "$mxgen" inspect --slabs --role deferred "$slabs" -e MilkySheet
check 'a message says that no pixel stores its bytes' eval 'grep -q "1 closure, 16 bytes" out && says "drawn forward"'
check 'a stored material has no message' eval 'exits 0 "$mxgen" inspect --slabs --role deferred "$slabs" -e CarPaint && test ! -s err'
check 'the hint of the old option of a budget is the new one' eval 'exits 2 "$mxgen" "$slabs" --max-closures 1 && says "(did you mean '\''--max-slabs'\''?)"'
check 'a material of slabs is inspected' exits 0 "$mxgen" inspect --slabs "$slabs" -e DustyFibre
check 'the view has slabs and steps' eval 'grep -q "3 slabs, 2 tangent bases, 3 closures, 60 bytes" out && grep -q "; tangent basis 2; " out && grep -q "to one slab" out'
check 'another material is inspected as slabs' exits 0 "$mxgen" inspect --slabs "$examples/marble.mtlx"
check 'the view says that slabs are made' grep -q 'a body, as slabs' out
check 'the view can be JSON' exits 0 "$mxgen" inspect --slabs --format json "$slabs" -e DustyFibre
check 'the JSON has slabs and steps' python3 -c 'import json
sheet = json.load(open("out"))
tree, = sheet["trees"]
assert [row["kind"] for row in tree["rows"]] == ["layer", "coverage", "slab", "layer", "slab", "slab"], tree
assert tree["cost"] == {"closures": 3, "bytes": 60} and len(sheet["steps"]) == 2
assert not sheet["toBudget"] and tree["tangentBases"] == 2
assert sorted({row["tangentBasis"] for row in tree["rows"] if row["kind"] == "slab"}) == [1, 2], tree
lights = [row["lightFromAbove"] for row in tree["rows"] if row["kind"] == "slab"]
assert lights[0] == 1 and 0 < lights[2] < lights[1] <= 1, lights'
cat >masks.mtlx <<'END'
<materialx version="1.39">
  <geompropvalue name="wear" type="float"><input name="geomprop" type="string" value="wear"/></geompropvalue>
  <slab name="a" type="BSDF"/>
  <slab name="b" type="BSDF"><input name="roughness" type="float" value="0.2"/></slab>
  <slab_mix name="worn" type="BSDF"><input name="fg" type="BSDF" nodename="a"/><input name="bg" type="BSDF" nodename="b"/>
    <input name="mix" type="float" nodename="wear"/></slab_mix>
  <slab_coverage name="patches" type="BSDF"><input name="in" type="BSDF" nodename="worn"/><input name="weight" type="float" nodename="wear"/></slab_coverage>
  <slab_surface name="out" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="patches"/></slab_surface>
</materialx>
END
check 'two operators with one mask are inspected' exits 0 "$mxgen" inspect --slabs masks.mtlx
check 'the view names operators with one mask' grep -qE '^  (worn and patches|patches and worn) share a mask, but count as independent' out
check 'operators with one mask are inspected as JSON' exits 0 "$mxgen" inspect --slabs --format json masks.mtlx
check 'the JSON names operators with one mask' python3 -c 'import json
tree, = json.load(open("out"))["trees"]
assert sorted(tree["sharedMasks"]) == ["patches", "worn"], tree'
sed 's/weight" type="float" nodename="wear"/weight" type="float" value="0.5"/' masks.mtlx >own.mtlx
check 'operators with masks of their own are not named' eval 'exits 0 "$mxgen" inspect --slabs own.mtlx && ! grep -q "share a mask" out'
check 'the JSON takes a budget' exits 0 "$mxgen" inspect --slabs --format json --max-bytes 30 "$slabs" -e DustyFibre
check 'the JSON says that the steps are to the budget' grep -q '"toBudget": true' out
check 'an unknown format is wrong usage' exits 2 "$mxgen" inspect --slabs --format pdf "$slabs"
check 'the error names the format' says "'pdf' is no format"
check 'a format without slabs is wrong usage' exits 2 "$mxgen" inspect --format json "$slabs"

# A mask that selects: a pixel has one side
cat >selected.mtlx <<'END'
<materialx version="1.39">
  <noise2d name="rust" type="float"/>
  <noise2d name="wet" type="float"><input name="amplitude" type="float" value="0.7"/></noise2d>
  <slab name="bare" type="BSDF"><input name="f90" type="color3" value="1, 0.98, 1"/><input name="diffuse_albedo" type="color3" value="0, 0, 0"/></slab>
  <slab name="rusty" type="BSDF"/>
  <slab name="water" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="mean_free_path" type="vector3" value="1, 2, 3"/></slab>
  <slab_select name="metal" type="BSDF"><input name="in1" type="BSDF" nodename="bare"/><input name="in2" type="BSDF" nodename="rusty"/><input name="mask" type="float" nodename="rust"/></slab_select>
  <slab_layer name="wetted" type="BSDF"><input name="top" type="BSDF" nodename="water"/><input name="base" type="BSDF" nodename="metal"/></slab_layer>
  <slab_select name="all" type="BSDF"><input name="in1" type="BSDF" nodename="metal"/><input name="in2" type="BSDF" nodename="wetted"/><input name="mask" type="float" nodename="wet"/></slab_select>
  <slab_surface name="Dry" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="metal"/></slab_surface>
  <slab_layer name="alone" type="BSDF"><input name="top" type="BSDF" nodename="water"/><input name="base" type="BSDF" nodename="bare"/></slab_layer>
  <slab_surface name="Alone" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="alone"/></slab_surface>
  <slab_surface name="Wet" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="all"/></slab_surface>
</materialx>
END
words() { # material: the words of its pixels
    "$mxgen" selected.mtlx -e "$1" --role deferred --target vulkan --reflect -o chosen && python3 -c 'import json, sys
print(json.load(open(f"chosen/{sys.argv[1]}.json"))["deferred"]["words"])' "$1"
}
check 'a selection is inspected' exits 0 "$mxgen" inspect --slabs selected.mtlx -e Dry
check 'the larger side counts' grep -q '1 closure, 16 bytes' out
check 'its pixels have as many words' eval '[ "$(words Dry)" = 4 ]'
check 'a selection of selections is inspected' exits 0 "$mxgen" inspect --slabs selected.mtlx -e Wet
check 'the largest of its sides counts' grep -q ' 2 closures, 28 bytes' out
check 'it takes the words of that side alone' eval '[ "$(words Wet)" = 7 ] && [ "$(words Alone)" = 7 ]'
check 'one slab at most keeps a selection' eval 'exits 0 "$mxgen" selected.mtlx -e Dry --max-slabs 1 -Wbudget-step -o made && ! says budget-step'

# Estimates see small patches, and bytes go where they are missed least
cat >badge.mtlx <<'END'
<materialx version="1.39">
  <position name="place" type="vector3"/>
  <extract name="x" type="float"><input name="in" type="vector3" nodename="place"/></extract>
  <smoothstep name="badge" type="float"><input name="in" type="float" nodename="x"/><input name="low" type="float" value="0.94"/><input name="high" type="float" value="0.95"/></smoothstep>
  <slab name="velvet" type="BSDF"><input name="diffuse_albedo" type="color3" value="0, 0, 0"/><input name="fuzz_amount" type="float" value="1"/></slab>
  <slab name="grey" type="BSDF"/>
  <slab_mix name="both" type="BSDF"><input name="fg" type="BSDF" nodename="velvet"/><input name="bg" type="BSDF" nodename="grey"/><input name="mix" type="float" nodename="badge"/></slab_mix>
  <slab_surface name="Badge" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="both"/></slab_surface>
</materialx>
END
check 'a patch of 3 % of a ball is seen' eval 'exits 0 "$mxgen" inspect --slabs badge.mtlx --features -fuzz && grep -qE "no fuzz: .* estimated error 0\.[1-9]" out'
check 'a small error keeps its fuzz' eval 'exits 0 "$mxgen" badge.mtlx --max-error 0.1 -Wbudget-step -o made && ! says "no fuzz"'
# The gold of this one has fuzz that is 1.1 off where it faces the viewer (`slab-faults-drawn` draws it).
check 'a patch counts as where it faces the viewer' eval 'exits 0 "$mxgen" inspect --slabs "$examples/../tests/slabs/faults/small_patch_estimate.mtlx" --features -fuzz && grep -qE "no fuzz: .* estimated error 0\.[3-9]" out'
check 'a small error keeps the fuzz of a patch' eval 'exits 0 "$mxgen" "$examples/../tests/slabs/faults/small_patch_estimate.mtlx" --max-error 0.1 -Wbudget-step -o made && says "one slab" && ! says "no fuzz"'
check 'bytes may go with a feature before a blend' eval 'exits 0 "$mxgen" "$slabs" -e WrappedSilk --max-bytes 56 -Wbudget-step -o made && says "no fuzz" && ! says "one slab"'

finish slabs
