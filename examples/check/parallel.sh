#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Distributes a check over hosts with GNU parallel. The hosts share the working directory and have mxgen in PATH.
#
#     parallel.sh HOSTS SHARDS PATH...     HOSTS: "4/alpha,4/beta", at most four shards at a time on each; ":" is this machine
#
# A shard with failures exits with 1. The exit code of the script is the exit code of the merge, which also detects missing
# shards. With BASELINE=FILE the merge compares the run with a baseline.
hosts=$1 count=$2
shift 2
rm -rf shards && mkdir -p shards || exit
parallel --sshlogin "$hosts" --workdir "$PWD" --quote \
    mxgen check --shard "{}/$count" -j 1 --quiet --json "shards/{}.json" "$@" ::: $(seq "$count") >shards/log 2>&1
exec mxgen check merge shards/*.json ${BASELINE:+--baseline "$BASELINE"} --json report.json --html report.html
