// SPDX-License-Identifier: Apache-2.0
/* The files of src/deferred/passes: each a NULL-terminated list of lines. */
#ifndef MXG_DEFERRED_TEXTS_H
#define MXG_DEFERRED_TEXTS_H

extern const char *const deferred_record[];
extern const char *const deferred_store_closure[];
extern const char *const deferred_tile[];
extern const char *const deferred_plane[];
extern const char *const deferred_diffuse[];
extern const char *const deferred_blur[];
extern const char *const deferred_write[];
extern const char *const deferred_read[];
extern const char *const deferred_frame[];
extern const char *const deferred_classify[];
extern const char *const deferred_light[];
extern const char *const deferred_compose[];
extern const char *const deferred_show[];
extern const char *const deferred_pack[];
extern const char *const deferred_unpack[];
extern const char *const deferred_light_rays[];
extern const char *const deferred_over_head[];
extern const char *const deferred_over[];
extern const char *const deferred_words[];
extern const char *const deferred_words_end[];
extern const char *const deferred_group[];
extern const char *const deferred_main[];
extern const char *const deferred_buffers[];
extern const char *const deferred_decals[];
extern const char *const deferred_closures[];

#endif
