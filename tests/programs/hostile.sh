#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Texts that an attacker may write into names, documents, stages and reports. Arguments: mxgen
mxgen=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"

material() { # NAME in XML
    printf '<?xml version="1.0"?>\n<materialx version="1.39"><standard_surface name="S" type="surfaceshader"/>
<surfacematerial name="%s" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>\n' "$1"
}

# Names become files and rules of make.
names=('x:&#10;all:&#10;&#9;touch&#9;pwned&#10;y' 'x:;touch${IFS}pwned;y' 'SHELL=touch' 'x&#13;y' 'x&#127;y' 'x&#x85;y' 'x&#x2028;y' 'x&#x202e;y' 'x\' 'x|y' 'x$(shell touch pwned)' 'x:y' 'x y' 'x#y' 'x\ y' 'x%y' '%' '*' 'x?y' 'x[a-z]' '~root')
for name in "${names[@]}"; do
    rm -rf made pwned d.d
    material "$name" >name.mtlx
    check "'$name' gives files" exits 0 "$mxgen" --sandbox name.mtlx -o made --depfile d.d
    check "'$name': two files without control characters" eval '[ "$(find made -type f | LC_ALL=C grep -c "^[ -~]*$")" -eq 2 ] && [ "$(find made -type f | wc -l)" -eq 2 ]'
    check "'$name': the depfile is one line without control characters" eval '[ "$(wc -l <d.d)" -eq 1 ] && ! LC_ALL=C grep -q "[^ -~]" d.d'
    printf 'default: stamp\nstamp:\n\ttouch stamp\n-include d.d\n' >rules
    check "'$name': make runs nothing" eval 'rm -f stamp; make -f rules >/dev/null && [ ! -e pwned ] && [ -e stamp ]'
    check "'$name': make knows the files" eval 'make -rR -f rules -pn 2>/dev/null >data; find made -type f | while read -r file; do grep -qF "$file: name.mtlx" data || exit 1; done'
done
two='<materialx version="1.39"><constant name="c" type="float"/><output name="a&#10;b" type="float" nodename="c"/><output name="a&#13;b" type="float" nodename="c"/></materialx>'
echo "$two" >two.mtlx
check 'names that differ in control characters give different files' eval '"$mxgen" two.mtlx -o different && [ "$(find different -name "*.frag" | wc -l)" -eq 2 ]'
check 'a printed file has a name in one line' eval '"$mxgen" two.mtlx --stdout | grep "^// a_b" | wc -l | grep -qx 4'

# Names become labels of Graphviz.
for name in '&quot; URL=&quot;x' '\&quot; URL=&quot;x' 'x\' 'x&#10;&quot; URL=&quot;x'; do
    echo "<materialx version=\"1.39\"><nodedef name=\"D\" node=\"g\"><input name=\"$name\" type=\"float\" value=\"0\"/><output name=\"out\" type=\"float\"/></nodedef>
<constant name=\"$name\" type=\"float\"/><g name=\"g\" type=\"float\"><input name=\"$name\" type=\"float\" nodename=\"$name\"/></g><output name=\"o$name\" type=\"float\" nodename=\"g\"/></materialx>" >dot.mtlx
    "$mxgen" inspect dot.mtlx --dot >dot 2>err
    check "'$name' stays in its label" eval '[ "$(grep -c label= dot)" -eq 5 ] && ! grep -Evx "digraph \{|    rankdir=LR|    node \[shape=box\]|\}|    n[0-9]+( -> n[0-9]+)? \[(shape=ellipse, )?label=\"([^\"\\\\]|\\\\.)*\"\]" dot'
done

# Names become lines of tables and views: nothing in them moves a cursor, ends a line, or hides or turns text.
name='x&#10;&#13;&#x7f;&#x9b;&#xad;&#x61c;&#x200b;&#x200e;&#x2028;&#x202e;&#x2060;&#x2066;&#xfeff;&#xe0041;y&#x302;'
echo "<materialx version=\"1.39\"><nodedef name=\"D\" node=\"g\"><input name=\"in\" type=\"float\" value=\"0\"/><output name=\"out\" type=\"float\"/></nodedef>
<nodegraph name=\"G\" nodedef=\"D\"><sin name=\"$name\" type=\"float\"><input name=\"in\" type=\"float\" interfacename=\"in\"/></sin><output name=\"out\" type=\"float\" nodename=\"$name\"/></nodegraph>
<noise2d name=\"n$name\" type=\"float\"/><g name=\"g$name\" type=\"float\"><input name=\"in\" type=\"float\" nodename=\"n$name\"/></g>
<dielectric_bsdf name=\"d$name\" type=\"BSDF\"><input name=\"weight\" type=\"float\" nodename=\"g$name\"/></dielectric_bsdf><oren_nayar_diffuse_bsdf name=\"o$name\" type=\"BSDF\"/>
<layer name=\"l$name\" type=\"BSDF\"><input name=\"top\" type=\"BSDF\" nodename=\"d$name\"/><input name=\"base\" type=\"BSDF\" nodename=\"o$name\"/></layer>
<surface name=\"s$name\" type=\"surfaceshader\"><input name=\"bsdf\" type=\"BSDF\" nodename=\"l$name\"/></surface>
<surfacematerial name=\"m$name\" type=\"material\"><input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"s$name\"/></surfacematerial>
<look name=\"L$name\"><materialassign name=\"a$name\" material=\"m$name\" geom=\"/\"/><materialassign name=\"b$name\" material=\"m$name\" geom=\"/x\"/></look></materialx>" >shown.mtlx
printf '/x\302\233\342\200\256\377y\n/x\n' >shown.txt
shown() { # FILE...: some '?', and a mark that belongs to its letter
    LC_ALL=C.UTF-8 grep -qP '\?{13}y\x{302}' "$@" && ! LC_ALL=C.UTF-8 grep -qP '[\x{7f}-\x{9f}\x{ad}\x{61c}\x{200b}\x{200e}\x{2028}-\x{202e}\x{2060}-\x{206f}\x{feff}\x{e0041}]' "$@"
}
for view in elements graph dot ir closures slabs; do
    check "inspect --$view shows names" eval '"$mxgen" inspect shown.mtlx --$view -q >view && shown view'
done
check 'bind shows names' eval '"$mxgen" bind shown.mtlx --stage shown.txt -q >view && shown view && [ "$(wc -l <view)" -eq 3 ] && grep -q "^/x???y" view'
check 'bind --geom shows names' eval '"$mxgen" bind shown.mtlx --stage shown.txt --geom /x -q >view && shown view && grep -q loses view'
check 'bind --json escapes names' eval '"$mxgen" bind shown.mtlx --stage shown.txt --json - -q >view && ! LC_ALL=C grep -qP "\x7f|\xc2[\x80-\x9f]|\xe2\x80\xae|\xf3" view && grep -qF "\u009b" view && grep -qF "\u202e" view && grep -qF "\udb40\udc41" view'
check 'messages show names' eval '"$mxgen" validate shown.mtlx 2>view; shown view'

# Names of textures that hosts read as URLs.
mkdir web
for name in 'https://example.org/a.png' 'file:../secret.png' '&#9;https:x' 'h&#10;ttps:x' '..\secret.png' '%2e%2E/secret.png' 'a/..%2f..%5csecret.png' '\\host\a.png' '%2ftmp/a.png' 'none/../../secret.png' './none/.././../secret.png' 'url.mtlx/../../secret.png'; do
    echo "<materialx version=\"1.39\"><image name=\"i\" type=\"color3\"><input name=\"file\" type=\"filename\" value=\"$name\"/></image><output name=\"o\" type=\"color3\" nodename=\"i\"/></materialx>" >web/url.mtlx
    check "a sandbox refuses '$name'" eval 'exits 1 "$mxgen" --sandbox web/url.mtlx -o web/out && has err "[texture-refused]" && exits 1 "$mxgen" validate --sandbox web/url.mtlx'
done
for name in 'a%20b.png' 'a/../b.png' 'a\..\b.png' '100%.png'; do
    sed "s|value=\"[^\"]*\"|value=\"$(printf %s "$name" | sed 's/\\/\\\\/g')\"|" web/url.mtlx >web/good.mtlx
    check "a sandbox admits '$name'" exits 0 "$mxgen" --sandbox web/good.mtlx -o web/out
done

# Files of an attacker stand in a folder.
mkdir folder && cp two.mtlx folder/$'a\nb.mtlx' && cp two.mtlx 'folder/x;touch pwned;y.mtlx'
check 'folders of outputs have no control characters' eval '"$mxgen" folder -o tree && [ -z "$(find tree | LC_ALL=C grep "[^ -~]")" ]'
for name in $'a\nb' 'x;touch pwned;y' 'a=b' 'a|b'; do
    mkdir "in" && cp two.mtlx "in/$name.mtlx"
    check "a depfile with '$name.mtlx' is an error" exits 1 "$mxgen" in -o tree --depfile f.d
    check "'$name.mtlx': the error is depfile-name" eval 'grep -q "\[depfile-name\]" err && [ ! -e f.d ]'
    check "check --depfile with '$name.mtlx' is an error" exits 1 "$mxgen" check in --no-compile --json r.json --depfile f.d
    check "check: '$name.mtlx' leaves no depfile" test ! -e f.d
    rm -r "in"
done

# Files of TOML.
mkdir show && material M >show/m.mtlx
no_control() { ! LC_ALL=C grep -q "$(printf '\033\\|\302\233')" "$@"; }
profile() { exits 2 "$mxgen" show/m.mtlx --profile p.toml -o made && no_control err && has err "$@"; }
budget() { exits 1 "$mxgen" check show --no-compile && no_control out err && has out '[budget-invalid]' "$@"; }
printf 'max-slabs = 1\n\0max-bytes = x\n' >p.toml
check 'nothing of a profile is left out behind a NUL' profile 'NUL'
printf 'max-slabs = 1\n"max-slabs" = 2\n' >p.toml
check 'an option stands once in a profile' profile "p.toml:2: error: 'max-slabs' stands above already"
printf '"\033[31m\302\23331m" = 1\n' >p.toml
check 'a message about a profile has no control characters' profile "unknown option '?[31m?31m'"
printf '\357\273\277max-slabs = 1\n\357\273\277slabs = true\n' >p.toml
check 'a byte order mark begins a file of TOML, and no other line' profile 'p.toml:2: error: a line is'
# Values that depend on the library or the target.
refused() { exits 1 "$mxgen" show/m.mtlx --profile p.toml -o made && has err "p.toml:2: error: '$1' is not a value of option '$2'"; }
while read -r key value; do
    printf '# a comment\n%s = ["%s"]\n' "$key" "$value" >p.toml
    check "a value of $key has its place in the profile" refused "$value" "$key"
    check "check tells the place of a value of $key" eval 'exits 1 "$mxgen" check show --no-compile --profile p.toml --json r.json && has out "p.toml:2: error: " && has r.json "\"p.toml\""'
done <<EOF
rename other
colorspace odd
lights odd=x
aovs odd=x
EOF
printf 'colorspace = "odd"\n' >p.toml
check "a value of the command line is not the profile's" eval 'exits 1 "$mxgen" show/m.mtlx --profile p.toml --colorspace odd -o made && grep -q "^error: .odd. is not" err'
printf 'rename = ["other"]\n' >p.toml
check "an item of the command line is not the profile's" eval 'exits 1 "$mxgen" show/m.mtlx --profile p.toml --rename oth -o made && grep -q "^error: .oth. is not" err && grep -q "^p.toml:1: error: .other. is not" err'
# Values that are wrong for every library and target.
while read -r key value; do
    printf '# a comment\n%s = "%s"\n' "$key" "$value" >p.toml
    check "'$value' is wrong usage as $key of a profile" profile "p.toml:2: error: '${value#-fuzz,}' is not a value of option '$key'; expected "
    check "'$value' is wrong usage as $key" eval 'exits 2 "$mxgen" show/m.mtlx "--$key=$value" -o made && has err "is not a value of option"'
done <<EOF
features odd
features -fuzz,fuzz
prefix 7up
prefix a__b
prefix gl_
prefix $(printf 'a%.0s' $(seq 65))
EOF
printf '\357\273\277[budget]\nmax-closure = 1\n' >show/mxgen.toml
check 'a byte order mark begins a file of budgets' budget 'mxgen.toml:2:'
printf '[budget]\n\0max-closures = x\n' >show/mxgen.toml
check 'nothing of budgets is left out behind a NUL' budget 'NUL'
printf '[budget]\n"\033[31m\302\23331m" = 1\n' >show/mxgen.toml
check 'a message about budgets has no control characters' budget "there is no budget '?[31m?31m'"
python3 -c 'print("features = [" + ", ".join(["\"-glints\""] * 200000) + "]")' >p.toml
check 'a long array takes no long time' exits 0 timeout 10 "$mxgen" show/m.mtlx --profile p.toml -o made

# Scenes that multiply.
material M | sed 's|</materialx>|<look name="L"><materialassign name="a" material="M" geom="/"/></look>&|' >scene.mtlx
stage() { printf '#usda 1.0\n%s\n' "$1" >stage.usda; }
refused() { # ID OPTION...
    local id=$1
    shift
    (ulimit -v 4000000; exits 1 timeout 60 "$mxgen" bind scene.mtlx --stage stage.usda "$@") && grep -q "\[$id\]" err
}
multiply() { # A B: names of prims; stdin: what is multiplied
    stage "$(echo 'class "c0" {'; cat; echo '}'; for i in $(seq 40); do echo "class \"c$i\" { def \"$1\" (references = </c$((i - 1))>) {}
def \"$2\" (references = </c$((i - 1))>) {} }"; done; echo 'def "r" (references = </c40>) {}')"
}
soon() { (ulimit -t 10; refused usda-size); }
long=$(printf 'x%.0s' $(seq 5000))
multiply a b <<<'def Mesh "m" {}'
check 'references that multiply are an error' soon
(echo 'def Mesh "m" {'; printf 'int p%s = 1\n' $(seq 20000); echo '}') | multiply a b
check 'properties that multiply are an error' soon
multiply "a$long" "b$long" <<<'def Mesh "m" { rel material:binding = </M> }'
check 'long names that multiply are an error' soon
multiply a b <<<'def Mesh "m" { rel material:bindng = </M> }'
check 'faults that multiply are an error' soon
(echo 'def Mesh "m" { rel material:binding:collection:c = [</c0.collection:c>, </M>] } rel collection:c:includes = ['; printf '</c0/m%s>,\n' $(seq 2000); echo '</c0/m>]') | multiply a b
check 'members of collections that multiply are an error' soon
stage "$(for _ in $(seq 1001); do printf 'def Xform "d"\n{\n'; done; for _ in $(seq 1001); do echo '}'; done)"
check 'deep prims are an error' refused usda-syntax
stage "$(for i in $(seq 100); do echo "def Mesh \"m$i\" { float p = 1 }"; done)"
check 'the limit of elements holds for a stage' refused too-many-elements --max-elements 100
printf '/a%s\n' $(seq 100) >stage.txt
check 'the limit of elements holds for a list' eval 'exits 1 "$mxgen" bind scene.mtlx --stage stage.txt --max-elements 50 && grep -q "\[scene-size\]" err'
printf '/%s' $(seq 1001) >stage.txt
check 'a deep path is an error' eval 'exits 1 "$mxgen" bind scene.mtlx --stage stage.txt && grep -q "\[bad-path\]" err'
(path=$(printf '/level%s' $(seq 500)); for i in $(seq 500); do echo "$path/$i"; done) >stage.txt
check 'the limit of outputs holds for layers' eval 'exits 1 "$mxgen" bind scene.mtlx --stage stage.txt --max-output-size 1 --json big.json && grep -q "\[output-limit\]" err && [ ! -e big.json ]'
check 'the limit of outputs holds for bindings.json' eval 'exits 1 "$mxgen" scene.mtlx --stage stage.txt --max-output-size 1 -o stacks && grep -q "\[output-limit\]" err && [ ! -e stacks/bindings.json ]'

# Names in USD.
name='M&gt;&#10;    asset x = @evil@&#10;    rel y = &lt;/Q&quot;\'
printf '<materialx version="1.39"><surface name="s" type="surfaceshader"/><surfacematerial name="%s" type="material"><input name="surfaceshader" type="surfaceshader" nodename="s"/></surfacematerial>
<look name="L"><materialassign name="a" material="%s" geom="/"/></look></materialx>' "$name" "$name" >usd.mtlx
printf '%s\n' /a '/b" (references = @evil.usd@) {}' '/b_(references = @evil.usd@) {}' '/1' /é >usd.txt
check 'bind --usda writes hostile names' exits 0 "$mxgen" bind usd.mtlx --stage usd.txt --usda usd.usda
check 'a warning tells that names are changed' grep -q '\[usda-loss\]' err
check 'names of USD are identifiers' eval 'sed "s/\"\(\\\\.\|[^\"\\]\)*\"//g" usd.usda >bare && ! grep -q "@" bare && [ "$(grep -c "^over " usd.usda)" -eq 5 ]'
check 'the stage can be read' exits 0 "$mxgen" bind --stage usd.usda scene.mtlx --look L

# Files that are written.
material M | sed 's/"surfaceshader" type="surfaceshader"/"surfaceshader"   type="surfaceshader"/' >wide.mtlx
sed 's/1.39/1.38/' wide.mtlx >old.mtlx
for verb in format upgrade; do
    cp wide.mtlx kept.mtlx && [ $verb = format ] || cp old.mtlx kept.mtlx
    chmod 640 kept.mtlx && ln -f kept.mtlx twin.mtlx && ln -sf kept.mtlx link.mtlx
    check "$verb -i of a link with another name" exits 0 "$mxgen" $verb -i link.mtlx
    check "$verb -i: the link stays" test -L link.mtlx
    check "$verb -i: the names share the file" test kept.mtlx -ef twin.mtlx
    check "$verb -i: the mode stays" test "$(stat -c %a kept.mtlx)" = 640
    check "$verb -i: the text is new" eval '! grep -q "   type" twin.mtlx && "$mxgen" $verb --check twin.mtlx'
    rm twin.mtlx && cp wide.mtlx kept.mtlx && chmod 604 kept.mtlx && [ $verb = format ] || cp old.mtlx kept.mtlx
    check "$verb -i: a single file keeps its mode, too" eval '"$mxgen" $verb -i link.mtlx && [ "$(stat -c %a kept.mtlx)" = 604 ] && [ -L link.mtlx ]'
    rm -f kept.mtlx link.mtlx
done
check 'nothing else is left' eval '[ -z "$(find . -name "*.tmp*")" ]'
printf '<?xml version="1.0"?>\n<materialx version="1.37">\n\n<aov name="a" type="color3"/>\n\n<!-- x -->\n\n<shader name="b"/>\n\n<material name="m"/>\n\n<opgraph name="o"/>\n\n</materialx>\n' >blank.mtlx
check 'upgrades of old elements' exits 0 "$mxgen" upgrade -i blank.mtlx
check 'an upgraded document is upgraded' exits 0 "$mxgen" upgrade --check blank.mtlx
check 'an upgraded document is formatted' exits 0 "$mxgen" format --check blank.mtlx
if unshare -rm true 2>/dev/null; then
    mkdir small
    cat >full.sh <<'X'
mount -t tmpfs -o size=48k none small && cd small && cp ../wide.mtlx keep.mtlx && ln keep.mtlx twin.mtlx || exit 77
head -c 100000 /dev/zero >filler 2>/dev/null
before=$(md5sum <keep.mtlx)
"$1" ../scene.mtlx -o . >out 2>../err; echo $? >../codes
"$1" format -i keep.mtlx 2>>../err; echo $? >>../codes
"$1" bind ../scene.mtlx --stage ../usd.txt --json layers.json 2>>../err; echo $? >>../codes
"$1" check ../scene.mtlx --no-compile --json report.json 2>>../err; echo $? >>../codes
"$1" ../scene.mtlx --stdout -q >/dev/full 2>>../err; echo $? >>../codes
[ "$(md5sum <keep.mtlx)" = "$before" ] && ls >../names
X
    check 'a disk is filled' unshare -rm bash full.sh "$mxgen"
    check 'a full disk fails each command' eval '[ "$(sort -u codes)" = 1 ] && [ "$(wc -l <codes)" -eq 5 ]'
    check 'the reason is told' eval '[ "$(grep -c "No space left on device" err)" -ge 5 ]'
    check 'no part of a file is left' eval '[ "$(grep -v "^out$" names | tr "\n" " ")" = "filler keep.mtlx twin.mtlx " ]'
    touch M.frag.1.tmp M.frag.2.tmp
    check 'process 1 writes beside old temporaries' unshare -rpf "$mxgen" scene.mtlx -o .
else
    skip 'no user namespaces'
fi

# Stages and meshes of others, through mxgen-render.
render=$(dirname "$mxgen")/mxgen-render
if [ -x "$render" ]; then
    mkdir -p stage/inside secret && cd stage || exit 1
    python3 "$here/hostile_stages.py" . ../secret
    mkfifo fifo.bin
    cp ../scene.mtlx look.mtlx
    fails() { # ID FILE LIMIT...: an error of this kind, in seconds and with little memory
        local id=$1 file=$2
        shift 2
        (ulimit -v 8000000; exits 1 timeout 60 "$mxgen" bind look.mtlx --stage "$file" "$@") && grep -q "\[$id\]" err
    }
    for file in nan_*.gltf deep.gltf deeper.gltf deep.dae deep.json.gltf expo.gltf fifo.gltf; do check "$file is an error" fails bad-mesh "$file"; done
    for file in zeros reuse weights targets names buffers joints; do check "$file.gltf is an error" fails bad-mesh "$file.gltf"; done
    check 'instances.gltf is an error' fails bad-geometry instances.gltf
    check 'a whole mesh is bound' exits 0 "$mxgen" bind look.mtlx --stage whole.gltf --sandbox
    for file in outside.gltf missing.gltf link.gltf outside.obj; do
        check "$file: --sandbox refuses it" fails bad-mesh "$file" --sandbox
        check "$file: the message is the same for all" grep -q "it is outside the folders that documents may read" err
    done
    check 'without --sandbox it is read' exits 0 "$mxgen" bind look.mtlx --stage outside.gltf
    check 'an include root is read' exits 0 "$mxgen" bind look.mtlx --stage outside.gltf --sandbox --include-root ../secret
    check '--max-file-size holds for files of a mesh' fails bad-mesh large.gltf --max-file-size 1
    for file in dome.usda dome_missing.usda; do
        check "$file: --sandbox refuses it" exits 1 "$render" look.mtlx --stage "$file" --sandbox -o p.png
        check "$file: the message is the same for all" grep -q "it is outside the folders that documents may read" err
    done
    check '--mesh has the same sandbox' exits 1 "$render" look.mtlx --mesh outside.gltf --sandbox -o p.png
    check '--mesh: the message is the same' grep -q "it is outside the folders that documents may read" err
    for file in instances.usda visits.usda ops.usda rotate.usda index.usda; do
        check "$file is an error" eval '(ulimit -v 8000000; exits 1 timeout 60 "$render" look.mtlx --stage "$file" -o p.png) && grep -q "\[bad-geometry\]" err'
    done
    # a killed command takes its renderer with it
    "$mxgen" bind look.mtlx --stage "$PWD/slow.obj" >/dev/null 2>&1 &
    command=$!
    for _ in $(seq 100); do child=$(pgrep -P $command mxgen-render) && break; sleep 0.05; done
    check 'the stage is read by another program' test -n "$child"
    kill -9 $command
    wait $command 2>/dev/null
    check 'it ends with its parent' eval '(for _ in $(seq 100); do [ -e /proc/$child ] || exit 0; sleep 0.05; done; exit 1)'
    cd ..
else
    skip 'mxgen-render is not built'
fi

# In a sandbox no link among the files of a folder leads out of it.
mkdir -p links outside
echo '<materialx version="1.39"><constant name="own" type="float"/><output name="o" type="float" nodename="own"/></materialx>' >links/own.mtlx
sed 's/own/hidden/g' links/own.mtlx >outside/hidden.mtlx
echo 'password: swordfish' >outside/secret.txt
ln -s ../outside/secret.txt links/mxgen.toml
check 'a budget file that is a link out of the sandbox is not read' eval 'exits 1 "$mxgen" check links/own.mtlx --no-compile --sandbox >out && ! grep -rq swordfish out err && grep -q "outside the folders" out err'
rm links/mxgen.toml
ln -s ../outside/secret.txt links/a.mtlx
ln -s ../outside/hidden.mtlx links/b.mtlx
ln -s own.mtlx links/inside.mtlx
for run in 'validate links' 'links -o linked' 'check links --no-compile' 'bake links -o baked' 'format links/a.mtlx links/b.mtlx' 'validate links/b.mtlx'; do
    check "mxgen $run: no link leads out of the sandbox" eval 'exits 1 "$mxgen" $run --sandbox >out && ! grep -Eq "swordfish|hidden" out && ! grep -Eq "swordfish|.hidden." err && grep -hq "it is outside the folders" out err'
done
check 'nothing of a file outside is generated' eval '[ "$(ls linked)" = "$(printf "inside\nown")" ] && ! grep -rq hidden linked'
check 'an include root allows it' exits 0 "$mxgen" validate links/b.mtlx --sandbox --include-root outside
check 'a link within the folder is allowed' exits 0 "$mxgen" validate links/inside.mtlx --sandbox
check 'without a sandbox links are files' exits 0 "$mxgen" validate links/b.mtlx

# Nor do tiles and frames.
printf 'P6 1 1 255 \377\000\000' >outside/red.ppm
mkdir -p sets
sampler() { # FILE
    echo "<materialx version=\"1.39\"><image name=\"i\" type=\"color3\"><input name=\"file\" type=\"filename\" value=\"$1\"/></image><standard_surface name=\"S\" type=\"surfaceshader\"><input name=\"base_color\" type=\"color3\" nodename=\"i\"/></standard_surface><surfacematerial name=\"M\" type=\"material\"><input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"S\"/></surfacematerial></materialx>"
}
sampler 't.&lt;UDIM&gt;.ppm' >sets/tiles.mtlx
sampler 'f{04frame}.ppm' >sets/frames.mtlx
sampler 'in{frame}/a.ppm' >sets/folders.mtlx
cp outside/red.ppm sets/t.1001.ppm
check 'tiles in the folder are allowed' exits 0 "$mxgen" validate sets/tiles.mtlx --sandbox
ln -s ../outside/red.ppm sets/t.1002.ppm
ln -s ../outside/red.ppm sets/f0033.ppm
for document in tiles frames folders; do
    for run in validate '' 'bake --copy'; do
        check "mxgen $run: the $document of a texture lead nowhere" eval 'exits 1 "$mxgen" $run sets/$document.mtlx -o copies --sandbox >out || exits 1 "$mxgen" $run sets/$document.mtlx --sandbox && grep -q "\[texture-refused\]" err && [ ! -e copies/t.1002.ppm ] && [ ! -e copies/f0033.ppm ]'
    done
done
rm sets/t.1002.ppm
mkfifo sets/t.1003.ppm
[ ! -x "$render" ] || check 'a pipe among tiles is not copied' eval 'exits 1 timeout 20 "$mxgen" bake --copy sets/tiles.mtlx -o copies && grep -q "not a regular file" err'

# A few lines make many elements, and many messages.
doubled() { # N: a node in N templates of two rows each
    local begin='' name='' end='' i
    for i in $(seq "$1"); do begin+="<template vars='v$i' rows='1;2'>" name+="@v$i@" end+='</template>'; done
    echo "<materialx version='1.39'>$begin<constant name='c$name' type='float'/>$end</materialx>"
}
doubled 11 >many.mtlx
doubled 24 >most.mtlx
check 'the warnings of a document are limited' eval 'exits 0 "$mxgen" validate many.mtlx && [ "$(grep -c "warning:" err)" = 1000 ] && grep -q "^note: more than 1000 warnings" err'
check '--max-errors 0 shows all' eval 'exits 0 "$mxgen" validate many.mtlx --max-errors 0 && [ "$(grep -c "warning:" err)" = 2048 ]'
check 'templates make a limited number of elements' eval '(ulimit -v 1000000; exits 1 timeout 20 "$mxgen" validate most.mtlx) && grep -q "at most \[template-bad\]" err'

finish hostile
