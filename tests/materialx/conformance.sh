#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The values of tests/conformance, drawn with MaterialX's own library in place of mxgen's; conformance.tsv lists the deviations.
# MXGEN_MATERIALX names a folder with MaterialX's libraries. Arguments: test_vulkan, the folder tests/conformance.
libraries=${MXGEN_MATERIALX:-}/libraries
if [ -z "${MXGEN_MATERIALX:-}" ] || [ ! -d "$libraries" ]; then
    echo "skip: MXGEN_MATERIALX does not name a folder with MaterialX's libraries"
    echo 'materialx-conformance: 0 passed, 0 failed, 1 skipped'
    exit 77
fi
exec "$1" vulkan "$2" complete 1 1 "$libraries" "$(dirname "$0")/conformance.tsv"
