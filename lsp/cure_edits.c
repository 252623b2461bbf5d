// SPDX-License-Identifier: Apache-2.0
/* Edits that cures are made of. */
#include "lsp/cures.h"
#include "lsp/wire.h"
#include "program/cli.h"

#include <stdlib.h>
#include <string.h>

void cure_replace(struct cure *cure, struct span span, const char *text)
{
    if (!cure->edits)
        cure->edits = json_array();
    json_array_append_new(cure->edits,
                          wire_edit(cure->query.session, cure->query.text, span, text));
}

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

void cure_remove_attribute(struct cure *cure, const struct model_attribute *attribute)
{
    uint32_t start = attribute->name.start;
    while (start > 0 && is_space(cure->query.text->bytes[start - 1]))
        --start;
    cure_replace(cure, (struct span){start, attribute->end}, "");
}

void cure_remove_element(struct cure *cure, uint32_t element)
{
    const struct text *text = cure->query.text;
    const struct model_element *removed = &cure->query.model->elements[element];
    struct span span = {removed->start, removed->end};
    while (span.start > 0
           && (text->bytes[span.start - 1] == ' ' || text->bytes[span.start - 1] == '\t'))
        --span.start;
    uint32_t end = span.end;
    while (end < text->len && (text->bytes[end] == ' ' || text->bytes[end] == '\t'))
        ++end;
    bool is_alone = (span.start == 0 || text->bytes[span.start - 1] == '\n')
                    && (text->bytes[end] == '\n' || text->bytes[end] == '\r');
    if (is_alone) {
        end += text->bytes[end] == '\r';
        end += text->bytes[end] == '\n';
        span.end = end;
    } else {
        span.start = removed->start;
    }
    cure_replace(cure, span, "");
}

void cure_set_attribute(struct cure *cure, uint32_t element, const char *name, const char *value)
{
    const struct model_attribute *there = query_attribute(&cure->query, element, name);
    if (there && there->has_value) {
        cure_replace(cure, there->value, value);
        return;
    }
    const struct model_element *owner = &cure->query.model->elements[element];
    uint32_t at = owner->name.end;
    if (owner->num_attributes)
        at = cure->query.model->attributes[owner->first_attribute + owner->num_attributes - 1].end;
    char *text = cli_format(" %s=\"%s\"", name, value);
    cure_replace(cure, (struct span){at, at}, text);
    free(text);
}

void cure_rename_element(struct cure *cure, uint32_t element, const char *category)
{
    const struct model_element *owner = &cure->query.model->elements[element];
    uint32_t len = owner->name.end - owner->name.start;
    cure_replace(cure, owner->name, category);
    if (owner->close < owner->end)
        cure_replace(cure, (struct span){owner->close + 2, owner->close + 2 + len}, category);
}

void cure_finish(struct cure *cure, const char *title, bool is_preferred)
{
    json_t *edits = cure->edits;
    cure->edits = NULL;
    if (!edits)
        return;
    json_t *action = json_object();
    json_object_set_new(action, "title", json_text(title));
    json_object_set_new(action, "kind", json_string("quickfix"));
    json_object_set_new(action, "diagnostics", json_pack("[O]", cure->diagnostic));
    if (is_preferred)
        json_object_set_new(action, "isPreferred", json_true());
    json_object_set_new(action, "edit",
                        wire_add_edits(wire_workspace_edit(), cure->query.document->uri, edits));
    json_array_append_new(cure->actions, action);
}

const char *cure_argument(const struct cure *cure, size_t index)
{
    return index < cure->finding->num_arguments ? cure->finding->arguments[index] : "";
}
