#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The shared library exports every function of mxgen.h and nothing else. Arguments: library, header.
set -euo pipefail
declared=$(grep '^MXG_API' "$2" | grep -o '\bmxg_[a-z_]*(' | tr -d '(' | sort -u)
exported=$(nm --dynamic --defined-only "$1" | awk '$2 != "A" { print $3 }' | sort -u)
if diff <(echo "$declared") <(echo "$exported"); then
    echo "symbols: $(echo "$declared" | wc -l) passed, 0 failed, 0 skipped"
else
    echo "symbols: 0 passed, 1 failed, 0 skipped"
    exit 1
fi
