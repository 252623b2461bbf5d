#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Spreads a check over hosts with GNU parallel. The hosts share the folder that this is started in, and have mxgen in PATH.
#
#     parallel.sh HOSTS SHARDS PATH...     HOSTS: "4/alpha,4/beta", at most four shards at a time on each; ":" is this machine
#
# A shard that finds failures ends with exit code 1, as it should; the exit code of the whole is that of the merge, which
# also notices shards that are missing.
hosts=$1 count=$2
shift 2
rm -rf shards && mkdir -p shards || exit
parallel --sshlogin "$hosts" --workdir "$PWD" --quote \
    mxgen check --shard "{}/$count" -j 1 --quiet --json "shards/{}.json" "$@" ::: $(seq "$count") >shards/log 2>&1
exec mxgen check merge shards/*.json --json report.json --html report.html
