// SPDX-License-Identifier: Apache-2.0
/*
 * mxgen export: a document in a format of others. It is translated to the model of the format and
 * baked, and a writer of the format makes files of the flat document (docs/export.md).
 */
#ifndef MXG_EXPORT_EXPORT_H
#define MXG_EXPORT_EXPORT_H

int export_main(int argc, char **argv);

#endif
