#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Incremental and distributed runs of mxgen check: the cache, also after kill -9, depfiles, shards and GNU parallel. Arguments: mxgen
mxgen=$(realpath "$1")
here=$(cd "$(dirname "$0")" && pwd)
examples=$here/../../examples/check
. "$here/../programs/common.sh"
. "$here/materials.sh"
mkdir programs && cp "$mxgen" "$(dirname "$mxgen")/mxgen-check" programs # with a path of their own, to find their processes by
mxgen=$work/programs/mxgen
export PATH=$work/programs:$PATH

mkdir show
for i in $(seq 12); do material "M$i" "0.$i" >"show/m$i.mtlx"; done
material Bad rough >show/bad.mtlx
cat >show/part.mtlx <<'END'
<materialx version="1.39"><standard_surface name="SR" type="surfaceshader"/></materialx>
END
cat >show/whole.mtlx <<'END'
<materialx version="1.39" xmlns:xi="http://www.w3.org/2001/XInclude">
  <xi:include href="part.mtlx"/>
  <surfacematerial name="W" type="material"><input name="surfaceshader" type="surfaceshader" nodename="SR"/></surfacematerial>
</materialx>
END
touch -d '1 hour ago' show/* # an include that is younger than the run is not remembered
check_show() { "$mxgen" check show --no-compile --cache cache "$@" >out 2>err; }
unchanged() { sed -n 's/.*; \([0-9]*\) documents\{0,1\} unchanged.*/\1/p' out; }

# The cache
check 'a first run fills the cache' exits 1 "$mxgen" check show --no-compile --cache cache --json first.json
check 'a first run finds nothing in the cache' is "$(unchanged)" ''
check 'a second run reads the cache' exits 1 "$mxgen" check show --no-compile --cache cache --json second.json
check 'a second run finds every document in the cache' is "$(unchanged)" 15
check 'both runs give the same report' cmp first.json second.json
material M1 0.99 >show/m1.mtlx
check_show
check 'a document that changed is checked again' is "$(unchanged)" 14
touch -d '1 hour ago' show/part.mtlx && check_show
check 'a document with another time only is not checked again' is "$(unchanged)" 15
sed 's/<standard_surface/<gltf_pbr/' show/part.mtlx >part && mv part show/part.mtlx && touch -d '1 hour ago' show/part.mtlx
check_show
check 'a changed include checks its documents again' is "$(unchanged)" 13 # itself and the whole
check_show --target essl
check 'other options are not in the cache' is "$(unchanged)" ''
mkdir library && echo '<materialx version="1.39"/>' >library/a.mtlx
check_show --library library
check 'another library is not in the cache' is "$(unchanged)" ''
check_show --library library
check 'the results of another library are kept in the cache' is "$(unchanged)" 15
echo '<materialx version="1.39"><!-- --></materialx>' >library/a.mtlx
check_show --library library
check 'a changed library checks all documents again' is "$(unchanged)" ''
sed 's/part.mtlx/later.mtlx/' show/whole.mtlx >waits.mtlx
"$mxgen" check waits.mtlx --no-compile --cache cache >out 2>err
cp show/part.mtlx later.mtlx
check 'an include that appears is seen' exits 0 "$mxgen" check waits.mtlx --no-compile --cache cache
mkdir textures
cat >textured.mtlx <<'END'
<materialx version="1.39">
  <image name="I" type="color3"><input name="file" type="filename" value="textures/wood.png"/></image>
  <output name="out" type="color3" nodename="I"/>
</materialx>
END
textured() { exits 0 "$mxgen" check textured.mtlx --no-compile --cache cache && is "$(unchanged)" "$1" && is "$(grep -c missing-texture out)" "$2"; }
check 'a missing texture is a warning' textured '' 1
check 'the warning of a missing texture comes from the cache' textured 1 1
touch textures/wood.png
check 'a texture that appears checks its document again' textured '' 0
check 'the result with the texture comes from the cache' textured 1 0
rm textures/wood.png
check 'a texture that disappears checks its document again' textured '' 1
for entry in cache/*/*.entry; do # still JSON, and no record any more
    sed -i 's/"passed"/"failed"/; s/"record"/"recurd"/' "$entry"
done
check 'damaged entries are made anew' exits 1 "$mxgen" check show --no-compile --cache cache --json damaged.json
check 'damaged entries do not change the report' eval '"$mxgen" check show --no-compile --json none.json >out 2>err; cmp damaged.json none.json'
check 'a run after damaged entries reads the cache' exits 1 "$mxgen" check show --no-compile --cache cache --json damaged.json
check 'the entries made anew are whole' is "$(unchanged)" 15
for entry in cache/*/*.entry; do printf 'x' >"$entry"; done
check 'entries of one byte are made anew' exits 1 "$mxgen" check show --no-compile --cache cache --json damaged.json
check 'entries of one byte do not change the report' eval 'exits 1 "$mxgen" check show --no-compile --json none.json && cmp damaged.json none.json'
check 'a cache that cannot be written changes no verdict' exits 0 "$mxgen" check show/m2.mtlx --no-compile --cache show/m1.mtlx
check 'a cache that cannot be written is a warning' grep -q '^warning: the cache' err

# A disk that is full, then has room, then is read only
mkdir disk
on_disk() { unshare -rm sh -c "mount -t tmpfs -o size=16k none disk && $1" >out 2>err; }
run='mxgen check show --no-compile --cache disk/cache'
if on_disk true; then
    check 'a full disk under the cache changes no verdict' on_disk "{ $run --json full.json; test \$? -eq 1; }"
    check 'a full disk under the cache is a warning' grep -q "^warning: the cache 'disk/cache' cannot be written: No space left" err
    check 'a full disk under the cache does not change the report' cmp full.json none.json
    check 'the entries on a full disk are whole' on_disk "{ $run; mount -o remount,size=8m disk; $run; $run --json again.json; test -z \"\$(find disk -name '*.tmp')\"; }"
    check 'the missing entries are made when there is room' is "$(sed -n 's/.*; \([0-9]*\) documents\{0,1\} unchanged.*/\1/p' out | tail -n 1)" 15
    check 'the report is the same with these entries' cmp again.json none.json
    check 'a read-only disk under the cache changes no verdict' on_disk "{ mount -o remount,ro disk; $run --json ro.json; test \$? -eq 1; }"
    check 'a read-only disk under the cache is a warning' grep -q "^warning: the cache 'disk/cache' cannot be written: Read-only" err
    check 'a read-only disk under the cache does not change the report' cmp ro.json none.json
    check 'a report on a read-only disk fails the run' on_disk "{ mount -o remount,ro disk; $run --json disk/r.json; test \$? -eq 1; }"
    check 'the error names the report on the read-only disk' grep -q "^error: cannot write 'disk/r.json': Read-only file system \[output-failed\]" err
    check 'a report on a full disk leaves no file' on_disk "{ head -c 12000 /dev/zero >disk/fill; mxgen check show --no-compile --json disk/r.json; test \$(ls disk) = fill; }"
    check 'the error names the report on the full disk' grep -q "^error: cannot write 'disk/r.json': No space left on device \[output-failed\]" err
else
    skip 'no file system of our own can be mounted here: full and read-only disks were not tried'
fi

# kill -9 at odd moments
for delay in 0.01 0.02 0.03 0.05 0.08 0.12 0.2; do
    "$mxgen" check show --no-compile --cache killed --json killed.json >/dev/null 2>&1 &
    sleep "$delay"
    kill -9 $! 2>/dev/null
    wait $! 2>/dev/null
done
whole() {
    find killed -name '*.entry' | while read -r entry; do
        [ "$(tail -n +2 "$entry" | sha256sum | cut -c -64)" = "$(head -n 1 "$entry")" ] || exit 1
    done
}
check 'kill -9 leaves no half entry' whole
check 'kill -9 leaves no half report' eval '[ ! -e killed.json ] || python3 -m json.tool killed.json'
check 'the run after kill -9 gives the right report' eval 'exits 1 "$mxgen" check show --no-compile --cache killed --json killed.json && cmp killed.json none.json'
sleep 0.2
check 'kill -9 leaves no worker' eval '! pgrep -f "$work/programs/mxgen-check"'

# Limits: of the files that the cache hashes, and of the memory of a worker
truncate -s 3G sparse.mtlx
cat >peak.py <<'P'
import resource, subprocess, sys
code = subprocess.run(sys.argv[2:], check=False).returncode
peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss // 1024
print(f"{peak} MiB", file=sys.stderr)
sys.exit(code if peak < int(sys.argv[1]) else 99)
P
check 'a document of 3 GiB fails without being read' exits 1 python3 peak.py 200 "$mxgen" check sparse.mtlx --cache cache --no-compile --max-file-size 1
check 'the error is file-too-large' grep -q 'larger than 1 MiB.*\[file-too-large\]' out
python3 - <<'P'
with open("heavy.mtlx", "w", encoding="ascii") as out:
    out.write('<materialx version="1.39"><position name="n0" type="vector3"/>')
    for i in range(1, 60000):
        out.write(f'<add name="n{i}" type="vector3"><input name="in1" type="vector3" nodename="n{i - 1}"/>'
                  f'<input name="in2" type="vector3" value="{i}, 1, 2"/></add>')
    out.write('<output name="o" type="vector3" nodename="n59999"/></materialx>')
P
if [ -n "${SANITIZER:-}" ]; then
    skip 'a worker with a sanitizer has no limit of memory'
else
    check 'a document that needs more memory than a worker has fails' exits 1 "$mxgen" check heavy.mtlx show/m2.mtlx -j1 --no-compile --memory-limit 48 --json heavy.json
    check 'the error is check-memory' grep -q 'a worker needs more than 48 MiB of memory: .*\[check-memory\]' out
    check 'the document after it is checked' says heavy.json '[x["status"] for x in d]' "['failed', 'passed']"
fi

# A run that ends while a worker waits: for the other end of a pipe
mkfifo pipe.mtlx
is_running() { case $(ps -o stat= -p "$1") in '' | Z*) return 1 ;; esac; }
for signal in TERM HUP KILL; do # a shell makes its background jobs ignore SIGINT
    # also where the tests themselves run under nohup
    env --default-signal=HUP "$mxgen" check pipe.mtlx --no-compile --json ended.json >/dev/null 2>&1 &
    run=$! worker=
    for _ in $(seq 200); do
        worker=$(pgrep -P "$run") && [ -n "$(find . -maxdepth 1 -name 'ended.json.*')" ] && break
        sleep 0.05
    done
    check "a worker waits before SIG$signal" test -n "$worker"
    kill -s "$signal" "$run"
    wait "$run" 2>/dev/null
    for _ in $(seq 200); do
        is_running "$worker" || break
        sleep 0.05
    done
    check "SIG$signal leaves no worker" eval '! is_running "$worker"'
    check 'a run that a signal ends leaves no report' test ! -e ended.json
    # no program can do anything about SIGKILL
    [ "$signal" = KILL ] || check "no half report is left by SIG$signal" test -z "$(find . -maxdepth 1 -name 'ended.json*')"
done
check 'a worker that starts after its run has ended ends at once' exits 1 env MXGEN_PARENT=999999999 "$work/programs/mxgen-check" </dev/null
rm -f ended.json*

# Depfiles
cat >Makefile <<END
report.json:
	$mxgen check show/whole.mtlx --no-compile -q --json report.json --depfile report.d
-include report.d
END
check 'make runs the check' make -s
check 'make does not run the check again' make -q
check 'a changed include makes the check run again' eval 'touch show/part.mtlx && ! make -q'
printf '[budget]\nmax-closures = 100\n' >show/mxgen.toml
echo show/whole.mtlx >list
"$mxgen" check show/whole.mtlx --no-compile --baseline base.json --update-baseline >/dev/null
check 'a depfile can be written' exits 0 "$mxgen" check @list --library library --no-compile --baseline base.json --json r.json --depfile r.d
for file in show/whole.mtlx show/part.mtlx show/mxgen.toml library/a.mtlx list base.json; do check "a depfile names $file" grep -q "^ $file\( \|\$\)" r.d; done
rm show/mxgen.toml
check 'a depfile without a report is wrong usage' exits 2 "$mxgen" check show --depfile x.d

# Shards
rm -rf shards && mkdir shards
for k in 1 2 3 4; do "$mxgen" check show --no-compile --shard $k/4 --json shards/$k.json >/dev/null; done
check 'the shards have each document once' is "$(cat shards/*.json | grep -c '^{"index"')" 15
check 'shards merge into one report' exits 1 "$mxgen" check merge shards/4.json shards/2.json shards/1.json shards/3.json --json merged.json --junit merged.xml
check 'merged shards give the report of one run' cmp merged.json none.json
check 'merged shards give the JUnit report of one run' eval 'exits 1 "$mxgen" check show --no-compile --junit none.xml && cmp merged.xml none.xml'
check 'a missing shard fails the merge' exits 1 "$mxgen" check merge shards/[124].json
check 'the error names the missing shard' grep -q 'shard 3 of 4 is missing \[shard-missing\]' err
check 'a missing shard is the only error' is "$(wc -l <err)" 1
check 'a missing last shard fails the merge' exits 1 "$mxgen" check merge shards/[123].json
check 'the error names the missing last shard' grep -q 'shard 4 of 4 is missing \[shard-missing\]' err
check 'two missing shards fail the merge' exits 1 "$mxgen" check merge shards/[24].json
check 'two missing shards are one error' is "$(cat err)" 'error: shards 1, 3 of 4 are missing [shard-missing]'
check 'a shard that is given twice fails the merge' exits 1 "$mxgen" check merge shards/*.json shards/2.json
check 'a shard that is given twice is one error' is "$(cat err)" "error: 'shards/2.json' and 'shards/2.json' are both shard 2 of 4 [shard-twice]"
check 'a shard given twice and a missing one fail the merge' exits 1 "$mxgen" check merge shards/[124].json shards/2.json
check 'a shard given twice and a missing one are two errors' eval 'grep -q "shard 3 of 4 is missing" err && is "$(grep -c shard-twice err)" 1'
"$mxgen" check show --no-compile --shard 1/2 --json other.json >/dev/null
check 'shards of two runs fail the merge' exits 1 "$mxgen" check merge shards/2.json other.json
check 'the error of two runs is shard-other' grep -q '\[shard-other\]' err
"$mxgen" check show --no-compile --target essl --shard 3/4 --json other3.json >/dev/null
check 'a shard with other targets fails the merge' exits 1 "$mxgen" check merge shards/[124].json other3.json
check 'the error names the shard with other targets' grep -q "'other3.json' and 'shards/1.json' are not shards of the same run \[shard-other\]" err
"$mxgen" check show --no-compile --json all.json >/dev/null
check 'two whole reports fail the merge' exits 1 "$mxgen" check merge all.json none.json
check 'the error of two whole reports is shard-other' grep -q '\[shard-other\]' err
check 'one whole report merges into itself' eval 'exits 1 "$mxgen" check merge all.json --json all2.json && cmp all.json all2.json'
mkdir partial
cp -r show partial/show
rm "$(find partial/show -name '*.mtlx' | sort | tail -n 1)"
(cd partial && "$mxgen" check show --no-compile --shard 3/4 --json 3.json >/dev/null)
check 'a shard of a folder that lacks a document fails the merge' exits 1 "$mxgen" check merge shards/[124].json partial/3.json --json partial.json
check 'the error says that the lists differ' grep -q "are not shards of the same run: their lists of documents differ \[shard-other\]" err
check 'it leads to no report' test ! -e partial.json
head -c $(($(wc -c <shards/2.json) / 2)) shards/2.json >cut.json
check 'half a shard fails the merge' exits 1 "$mxgen" check merge shards/[134].json cut.json --json half.json
check 'the error of half a shard is report-unreadable' grep -q '\[report-unreadable\]' err
check 'half a shard leads to no report' test ! -e half.json
check 'a document in place of a shard fails the merge' exits 1 "$mxgen" check merge show/m1.mtlx
python3 -m json.tool shards/1.json >pretty.json
check 'a shard may be formatted by others' exits 1 "$mxgen" check merge pretty.json shards/[234].json --json pretty_merged.json
check 'a formatted shard gives the same report' cmp pretty_merged.json none.json
check 'a shard must be one from 1 to N' eval 'exits 2 "$mxgen" check show --shard 0/4 && exits 2 "$mxgen" check show --shard 5/4 && exits 2 "$mxgen" check show --shard 1'
check 'an empty shard passes' exits 0 "$mxgen" check show/m2.mtlx --no-compile --shard 2/2

# GNU parallel over hosts: this one
if command -v parallel >/dev/null; then
    check 'GNU parallel runs the shards' exits 1 "$examples/parallel.sh" 2/: 4 show --no-compile
    check 'GNU parallel gives the report of one run' cmp report.json none.json
    "$mxgen" check show --no-compile --baseline parallel.json --update-baseline >/dev/null
    check 'GNU parallel compares with a baseline' env BASELINE=parallel.json "$examples/parallel.sh" 2/: 4 show --no-compile
else
    skip 'GNU parallel is not installed'
fi

finish check-spread
