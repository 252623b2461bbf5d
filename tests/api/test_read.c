// SPDX-License-Identifier: Apache-2.0
/* Documents as objects: their elements, values and links. */
#include "edit_fixture.h"

static void test_elements(struct fixture *f)
{
    const mxg_document *d = f->document;
    mxg_element root = element_at(d, ""), graph = element_at(d, "G"),
                coat = element_at(d, "S/coat");
    mxg_element_info info = MXG_INIT(mxg_element_info);
    REQUIRE_EQ(mxg_document_element(d, coat, &info), MXG_OK);
    REQUIRE_STR(info.category, "input");
    REQUIRE_STR(info.name, "coat");
    REQUIRE_STR(info.type, "float");
    REQUIRE_STR(info.file, "main.mtlx");
    REQUIRE_EQ(info.line, 13);
    REQUIRE_EQ(info.column, 5);
    REQUIRE_EQ(info.parent, element_at(d, "S"));
    REQUIRE_EQ(info.num_attributes, 2);
    REQUIRE_EQ(mxg_document_find_element(d, info.parent, "coat"), coat);
    REQUIRE_STR(attribute_of(d, coat, "value"), "0.5");
    REQUIRE_EQ(mxg_document_find_attribute(d, coat, "none"), MXG_NONE);
    REQUIRE_EQ(mxg_document_find_attribute(d, coat, NULL), MXG_NONE);
    REQUIRE_EQ(mxg_document_find_attribute(NULL, coat, "value"), MXG_NONE);
    REQUIRE(!attribute_of(d, coat, "uiname"));
    mxg_attribute attribute = MXG_INIT(mxg_attribute);
    REQUIRE_EQ(mxg_document_attribute(d, coat, 1, &attribute), MXG_OK);
    REQUIRE_STR(attribute.name, "value");
    REQUIRE_EQ(mxg_document_attribute(d, coat, 2, &attribute), MXG_ERROR_ARGUMENT);
    /* children in document order: the two of the included file come first */
    REQUIRE_EQ(mxg_document_element(d, root, &info), MXG_OK);
    unsigned children = 0;
    for (mxg_element e = info.first_child; e; e = info.next, children++)
        REQUIRE_EQ(mxg_document_element(d, e, &info), MXG_OK);
    REQUIRE_EQ(children, 5);
    char path[64];
    REQUIRE_EQ(mxg_document_element_path(d, element_at(d, "/G/n"), path, sizeof path), 3);
    REQUIRE_STR(path, "G/n");
    REQUIRE_EQ(mxg_document_element_path(d, coat, path, 3), 6);
    REQUIRE_STR(path, "S/");
    REQUIRE_EQ(mxg_document_element_path(d, root, path, sizeof path), 0);
    REQUIRE_EQ(mxg_document_element_path(d, coat, NULL, 7), 6);
    /* numbers that are no element, and elements of the library */
    REQUIRE_EQ(mxg_document_element(d, 0, &info), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_document_element(d, 1, &info), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_document_element(d, UINT32_MAX, &info), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(element_at(d, "ND_mix_float"), 0);
    REQUIRE_EQ(element_at(d, "G/none"), 0);
    REQUIRE_EQ(mxg_document_find_element(NULL, graph, "n"), 0);
}

static void test_values(struct fixture *f)
{
    mxg_document *d = parse(f, "<materialx version='1.39'><standard_surface name='S' "
                               "type='surfaceshader'>"
                               "<input name='a' type='color3' value='1, 0.5, 0'/>"
                               "<input name='b' type='integer' value='16777217'/>"
                               "<input name='c' type='boolean' value='true'/>"
                               "<input name='d' type='string' value='oren'/>"
                               "<input name='e' type='float' value='wide'/>"
                               "<input name='f' type='float' nodename='N'/>"
                               "</standard_surface></materialx>");
    mxg_value value = MXG_INIT(mxg_value);
    REQUIRE_EQ(mxg_document_value(d, element_at(d, "S/a"), &value), MXG_OK);
    REQUIRE_EQ(value.num_values, 3);
    REQUIRE(value.values[0] == 1 && value.values[1] == 0.5f && value.values[2] == 0);
    REQUIRE_STR(value.type, "color3");
    REQUIRE_EQ(mxg_document_value(d, element_at(d, "S/b"), &value), MXG_OK);
    REQUIRE_EQ(value.integer, 16777217);
    REQUIRE_EQ(value.num_values, 1);
    REQUIRE_EQ(mxg_document_value(d, element_at(d, "S/c"), &value), MXG_OK);
    REQUIRE(value.num_values == 1 && value.values[0] == 1);
    REQUIRE_EQ(mxg_document_value(d, element_at(d, "S/d"), &value), MXG_OK);
    REQUIRE_EQ(value.num_values, 0);
    REQUIRE_STR(value.text, "oren");
    REQUIRE_EQ(mxg_document_value(d, element_at(d, "S/e"), &value), MXG_OK);
    REQUIRE_EQ(value.num_values, 0);
    REQUIRE_EQ(mxg_document_value(d, element_at(d, "S/f"), &value), MXG_ERROR_ARGUMENT);
    mxg_document_destroy(d);
}

static void test_links(struct fixture *f)
{
    const mxg_document *d = f->document;
    mxg_connection link = MXG_INIT(mxg_connection);
    REQUIRE_EQ(mxg_document_connection(d, element_at(d, "S/base_color"), &link), MXG_OK);
    REQUIRE_EQ(link.source, element_at(d, "G"));
    REQUIRE_STR(link.output, "out");
    REQUIRE_EQ(mxg_document_connection(d, element_at(d, "G/n/amplitude"), &link), MXG_OK);
    REQUIRE_EQ(link.source, element_at(d, "G/scale"));
    REQUIRE_STR(link.interfacename, "scale");
    REQUIRE_EQ(mxg_document_connection(d, element_at(d, "G/out"), &link), MXG_OK);
    REQUIRE_EQ(link.source, element_at(d, "G/t"));
    REQUIRE_EQ(mxg_document_connection(d, element_at(d, "S/coat"), &link), MXG_ERROR_ARGUMENT);
    mxg_document *broken = parse(f, "<materialx version='1.39'><output name='o' type='float' "
                                    "nodename='none'/></materialx>");
    REQUIRE_EQ(mxg_document_connection(broken, element_at(broken, "o"), &link), MXG_ERROR_DOCUMENT);
    mxg_document_destroy(broken);
    /* definitions of the library and of the document */
    uint32_t nodedef;
    mxg_nodedef definition = MXG_INIT(mxg_nodedef);
    REQUIRE((nodedef = mxg_document_find_nodedef(d, element_at(d, "S"))) != MXG_NONE);
    REQUIRE_EQ(mxg_document_nodedef(d, nodedef, &definition), MXG_OK);
    REQUIRE_STR(definition.name, "ND_standard_surface_surfaceshader");
    REQUIRE((nodedef = mxg_document_find_nodedef(d, element_at(d, "G/t"))) != MXG_NONE);
    REQUIRE_EQ(mxg_document_nodedef(d, nodedef, &definition), MXG_OK);
    REQUIRE_STR(definition.name, "ND_tint");
    REQUIRE_EQ(nodedef + 1, mxg_document_num_nodedefs(d));
    mxg_port port = MXG_INIT(mxg_port);
    REQUIRE_EQ(mxg_document_port(d, nodedef, 1, &port), MXG_OK);
    REQUIRE_STR(port.name, "by");
    REQUIRE_EQ(mxg_document_port(d, nodedef, 3, &port), MXG_ERROR_ARGUMENT);
    mxg_implementation implementation = MXG_INIT(mxg_implementation);
    REQUIRE_EQ(mxg_document_num_implementations(d, nodedef), 1);
    REQUIRE_EQ(mxg_document_implementation(d, nodedef, 0, &implementation), MXG_OK);
    REQUIRE_STR(implementation.function, "tint");
    REQUIRE_STR(implementation.nodegraph, "");
    REQUIRE_EQ(mxg_document_implementation(d, nodedef, 1, &implementation), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_document_num_implementations(d, nodedef + 1), 0);
    REQUIRE_EQ(mxg_document_find_nodedef(d, element_at(d, "G")), MXG_NONE);
}

static void (*const tests[])(struct fixture *f) = {test_elements, test_values, test_links};

int main(void)
{
    for (size_t i = 0; i < sizeof tests / sizeof *tests; i++) {
        struct fixture f;
        open_fixture(&f);
        tests[i](&f);
        close_fixture(&f);
    }
    return test_report("api-read");
}
