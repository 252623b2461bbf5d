#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The shared library exports every function of the public headers and nothing else. Arguments: library, headers.
set -euo pipefail
library=$1
shift
declared=$(grep -h '^MXG_API' "$@" | grep -o '\bmxg_[a-z_]*(' | tr -d '(' | sort -u)
exported=$(nm --dynamic --defined-only "$library" | awk '$2 != "A" { print $3 }' | sort -u)
if diff <(echo "$declared") <(echo "$exported"); then
    echo "symbols: $(echo "$declared" | wc -l) passed, 0 failed, 0 skipped"
else
    echo "symbols: 0 passed, 1 failed, 0 skipped"
    exit 1
fi
