// SPDX-License-Identifier: Apache-2.0
/* Offsets in a source as lines and columns. */
#include "xml/xml_priv.h"

#include <assert.h>

static uint32_t count_code_points(const struct xml_source *source, size_t begin, size_t end)
{
    assert(begin <= end && end <= source->size);
    uint32_t count = (uint32_t)(end - begin);
    for (size_t at = begin; at < end && !source->is_ascii; at++)
        /* continuation bytes do not count */
        count -= ((unsigned char)source->text[at] & 0xc0) == 0x80;
    return count;
}

uint32_t xml_column(struct xml_source *source, size_t offset)
{
    struct xml_position *p = &source->position;
    if (offset < p->offset || p->line == 0)
        *p = (struct xml_position){.line = 1};
    for (const char *newline;
         (newline = memchr(source->text + p->offset, '\n', offset - p->offset)) != NULL;
         p->line++) {
        p->offset = (size_t)(newline - source->text) + 1;
        p->before = 0;
    }
    p->before += count_code_points(source, p->offset, offset);
    p->offset = offset;
    assert(p->line > 0);
    return p->before + 1;
}

struct diag_place xml_place(struct xml_reader *reader, size_t offset)
{
    struct xml_source *source = reader->source;
    uint32_t column = xml_column(source, offset);
    return (struct diag_place){.file = doc_file_name(reader->doc, source->file),
                               .line = source->position.line,
                               .column = column};
}
