// SPDX-License-Identifier: Apache-2.0
/*
 * Whether the nodes of a definition's graph can have the values that a node gives: what the node
 * converts behind its graph, or before it, they have to convert, too.
 */
#include "api/edit.h"

struct flat_check {
    struct edit_change *c;
    const struct library *lib; /* the definitions that the edit knows */
    const struct document *doc;
    elem_id graph;
    const struct nodedef *definition;
    uint32_t nodedef;
};

/* The input of the graph around the node, or of the definition of that graph; 0: there is none. */
static elem_id interface_input(const struct flat_check *check, str_id name)
{
    elem_id around = doc_element(check->doc, check->c->element)->parent;
    elem_id own = doc_child_of_kind(check->doc, around, KIND_INPUT, name);
    str_id definition = own ? 0 : doc_attr_value(check->doc, around, STR_nodedef);
    uint32_t nodedef = definition ? library_nodedef_by_name(check->lib, definition) : LIBRARY_NONE;
    int index = nodedef == LIBRARY_NONE ? -1 : library_find_input(check->lib, nodedef, name);
    return index < 0 ? own : library_ports(check->lib, nodedef, NULL)[index].element;
}

/* The element that says what the value of an input is: of the node, or the default. */
static elem_id holder(const struct flat_check *check, const struct port *port)
{
    elem_id own = doc_child_of_kind(check->doc, check->c->element, KIND_INPUT, port->name);
    str_id name = own ? doc_attr_value(check->doc, own, STR_interfacename) : 0;
    elem_id there = name ? interface_input(check, name) : 0;
    return there ? there : own ? own : port->element;
}

/* True if an output of the graph is more than the node that reads the file. */
static bool changes_file(const struct flat_check *check, str_id input)
{
    const struct document *doc = check->doc;
    for (unsigned i = 0; i < check->definition->num_outputs; i++) {
        elem_id output =
            library_inner_output(check->lib, check->nodedef, i, check->doc, check->graph);
        elem_id node = doc_child(doc, check->graph, doc_attr_value(doc, output, STR_nodename));
        elem_id reader = node ? doc_element(doc, node)->first_child : 0;
        while (reader && doc_attr_value(doc, reader, STR_interfacename) != input)
            reader = doc_element(doc, reader)->next;
        if (!reader)
            return true;
    }
    return false;
}

/* True if the graph states the attribute, or its images are converted instead of its results. */
static bool is_inside(const struct flat_check *check, const struct port *port, str_id attr)
{
    return library_graph_says(check->lib, check->graph, port->name, attr)
           || library_images_convert(check->lib, check->nodedef, attr);
}

/* True if the results are converted from the space or the unit of a file. */
static bool is_converted(const struct flat_check *check, const struct port *port, elem_id from)
{
    bool is_library = from < check->doc->first_element;
    str_id space = is_library ? doc_attr_value(check->doc, from, STR_colorspace)
                              : doc_inherited_attr(check->doc, from, STR_colorspace);
    const char *name = library_canonical_space(str_text(check->doc->strings, space));
    bool has_space = space && strcmp(name, "none") != 0 && strcmp(name, library_color_hub) != 0;
    return (has_space && !is_inside(check, port, STR_colorspace))
           || (doc_attr_value(check->doc, from, STR_unit) && !is_inside(check, port, STR_unit));
}

static void check_input(const struct flat_check *check, const struct port *port)
{
    elem_id node = check->c->element, from = holder(check, port);
    const char *label = edit_label(check->c->edit, node),
               *input = str_text(check->doc->strings, port->name);
    if (port->type == DOC_TYPE_filename) {
        if (is_converted(check, port, from) && changes_file(check, port->name))
            edit_fail(check->c,
                      "the results of '%s' are converted from the colour space or unit of the file "
                      "'%s', and a part of its nodegraph cannot be",
                      label, input);
        return;
    }
    str_id declared = doc_attr_value(check->doc, port->element, STR_unit),
           other = doc_attr_value(check->doc, from, STR_unit);
    elem_id own = doc_child_of_kind(check->doc, node, KIND_INPUT, port->name);
    bool is_interface = own && own != from;
    if (is_interface && declared && other && declared != other)
        edit_fail(check->c, "'%s' of '%s' is in '%s', and what it reads in '%s'", input, label,
                  str_text(check->doc->strings, declared), str_text(check->doc->strings, other));
}

void edit_check_flat(struct edit_change *c, const struct library *lib, uint32_t nodedef,
                     elem_id graph)
{
    struct flat_check check = {
        c, lib, edit_tree(c->edit), graph, library_nodedef(lib, nodedef), nodedef};
    const struct port *ports = library_ports(lib, nodedef, NULL);
    for (uint32_t i = 0; i < check.definition->num_inputs && !c->failed; i++)
        check_input(&check, &ports[i]);
}
