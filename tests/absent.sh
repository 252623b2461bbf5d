#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Stands for a test that this build cannot have. Argument: what was not found when it was configured.
echo "skip: this build is without $1"
exit 77
