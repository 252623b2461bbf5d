// SPDX-License-Identifier: Apache-2.0
/*
 * MaterialX's proposal for AOVs (MaterialX.Proposals.md, "AOV Output Elements") as nodes, so that
 * nothing else knows of it:
 *
 *     <aovoutput name="a" type="T" aovname="n" nodename="x"/>               aov(name=n, value=x)
 *     <aovoutput name="a" type="T" aovname="n" nodename="x" sourceaov="s"/>
 *                                                           aovpass(name=n, source=s, shader=x)
 */
#include "document/document.h"

static elem_id add_input(struct document *doc, elem_id node, str_id name, str_id type)
{
    elem_id input = doc_add_like(doc, node, STR_input, name, node);
    doc_add_attr(doc, input, (struct attribute){.name = STR_type, .value = type});
    return input;
}

static void add_text(struct document *doc, elem_id node, str_id name, str_id value)
{
    elem_id input = add_input(doc, node, name, STR_string);
    doc_add_attr(doc, input, (struct attribute){.name = STR_value, .value = value});
}

/* Moves the connection of the element to an input. */
static void connect(struct document *doc, elem_id node, elem_id input)
{
    for (size_t i = 0; i < DOC_NUM_CONNECTIONS; i++) {
        const struct attribute *found = doc_attr(doc, node, doc_connections[i]);
        if (!found)
            continue;
        struct attribute attr = *found; /* attributes move when one is added */
        doc_add_attr(doc, input, attr);
        doc_remove_attr(doc, node, attr.name);
    }
}

static void rewrite(struct document *doc, elem_id element)
{
    str_id source = doc_attr_value(doc, element, STR_sourceaov);
    doc_set_category(doc, element, source ? STR_aovpass : STR_aov);
    add_text(doc, element, STR_name, doc_attr_value(doc, element, STR_aovname));
    if (source)
        add_text(doc, element, STR_source, source);
    elem_id value =
        source ? add_input(doc, element, STR_shader, STR_surfaceshader)
               : add_input(doc, element, STR_value, doc_attr_value(doc, element, STR_type));
    connect(doc, element, value);
    doc_remove_attr(doc, element, STR_aovname);
    doc_remove_attr(doc, element, STR_sourceaov);
}

void doc_rewrite_aovs(struct document *doc)
{
    for (elem_id e = doc_element(doc, doc->root)->first_child; e; e = doc_element(doc, e)->next) {
        if (doc_element(doc, e)->kind != KIND_NODEGRAPH)
            continue;
        for (elem_id child = doc_element(doc, e)->first_child; child;
             child = doc_element(doc, child)->next)
            if (doc_element(doc, child)->category == STR_aovoutput)
                rewrite(doc, child);
    }
}
