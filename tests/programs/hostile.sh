#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What an attacker may write into names, documents, stages and reports. Arguments: mxgen
mxgen=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
. "$here/common.sh"

material() { # NAME in XML
    printf '<?xml version="1.0"?>\n<materialx version="1.39"><standard_surface name="S" type="surfaceshader"/>
<surfacematerial name="%s" type="material"><input name="surfaceshader" type="surfaceshader" nodename="S"/></surfacematerial></materialx>\n' "$1"
}

# Names become files and rules of make.
names=('x:&#10;all:&#10;&#9;touch&#9;pwned&#10;y' 'x:;touch${IFS}pwned;y' 'SHELL=touch' 'x&#13;y' 'x&#127;y' 'x&#x85;y' 'x&#x2028;y' 'x&#x202e;y' 'x\' 'x|y' 'x$(shell touch pwned)' 'x:y' 'x y' 'x#y' 'x\ y')
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
finish hostile
