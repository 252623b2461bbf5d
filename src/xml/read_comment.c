// SPDX-License-Identifier: Apache-2.0
/*
 * Comments and blank lines. A comment belongs to the element that follows it, to the element that
 * ends on its line, or, behind all children, to the parent. Several blank lines count as one; those
 * at the begin and at the end of an element do not count.
 */
#include "xml/xml_priv.h"

#include <assert.h>

static void give_comments(struct xml_reader *reader, elem_id element, enum comment_place place)
{
    struct xml_source *source = reader->source;
    for (uint32_t i = 0; i < source->comments.len; i++)
        doc_add_comment(reader->doc, element, place, source->comments.items[i]);
    source->comments.len = 0;
}

static void see_blank_line(struct xml_reader *reader)
{
    struct xml_source *source = reader->source;
    if (source->num_line_ends > 1 && !source->is_first)
        vec_push(&reader->scratch, &source->comments, STR_EMPTY);
}

static void begin_part(struct xml_source *source, elem_id ended, bool is_first)
{
    source->num_line_ends = 0;
    source->ended = ended;
    source->is_first = is_first;
}

void xml_see_comment(struct xml_reader *reader, str_id text)
{
    struct xml_source *source = reader->source;
    if (!reader->doc->keeps_comments)
        return;
    if (source->ended && !source->num_line_ends) {
        doc_add_comment(reader->doc, source->ended, COMMENT_BEHIND, text);
        return;
    }
    see_blank_line(reader);
    vec_push(&reader->scratch, &source->comments, text);
    begin_part(source, 0, false);
}

void xml_see_start(struct xml_reader *reader, elem_id element)
{
    if (!reader->doc->keeps_comments)
        return;
    see_blank_line(reader);
    give_comments(reader, element, COMMENT_BEFORE);
    begin_part(reader->source, 0, true);
}

void xml_see_end(struct xml_reader *reader, elem_id element)
{
    if (!reader->doc->keeps_comments)
        return;
    give_comments(reader, element, COMMENT_LAST);
    begin_part(reader->source, element, false);
}

void xml_see_file_end(struct xml_reader *reader, elem_id root)
{
    assert(!doc_element(reader->doc, root)->parent);
    give_comments(reader, root, COMMENT_BEHIND);
}
