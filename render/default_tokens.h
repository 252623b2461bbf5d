// SPDX-License-Identifier: Apache-2.0
/*
 * Tokens in names of files: "<id>" stands for a value of the geometry, and for that of a
 * <tokendefault> where no <geominfo> gives one (GeomExts, "TokenDefault Elements").
 */
#ifndef MXG_RENDER_DEFAULT_TOKENS_H
#define MXG_RENDER_DEFAULT_TOKENS_H

#include "render/bind_shader.h"

/*
 * The defaults of a document, whose texts they have. for_all_geometry: without those that a
 * <geominfo> replaces somewhere; otherwise the picture has no geometry of the document.
 */
void default_tokens_find(const mxg_document *document, const mxg_context *context,
                         bool for_all_geometry, struct bind_tokens *out);
void default_tokens_finish(struct bind_tokens *tokens);

/* The name of a file with the values of its tokens. The caller frees it. */
char *tokens_replace(const struct bind_tokens *tokens, const char *file);
/* The name with the defaults that hold for all geometry. The caller frees it. */
char *default_tokens_replace(const mxg_document *document, const char *file);

#endif
