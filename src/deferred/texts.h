// SPDX-License-Identifier: Apache-2.0
/* The files of src/deferred/passes: each a NULL-terminated list of lines. */
#ifndef MXG_DEFERRED_TEXTS_H
#define MXG_DEFERRED_TEXTS_H

extern const char *const deferred_record[],
    *const deferred_write[], *const deferred_read[], *const deferred_frame[],
                                                         *const deferred_classify[],
                                                             *const deferred_light[],
                                                                 *const deferred_compose[],
                                                                     *const deferred_show[],
                                                                         *const deferred_closures[];

#endif
