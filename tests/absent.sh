#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Replaces a test that this build cannot run. Argument: the missing dependency.
echo "skip: this build is without $1"
exit 77
