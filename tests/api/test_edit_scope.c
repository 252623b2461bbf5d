// SPDX-License-Identifier: Apache-2.0
/* Elements that are copied or moved keep what the elements around them said about their values. */
#include "fixture.h"

#include <mxgen/document.h>

#include <stdio.h>

#define HEAD "<?xml version='1.0'?><materialx version='1.39'"
#define GRAPH \
    "<nodegraph name='G' fileprefix='own/'>" \
    "<constant name='tint' type='color3'>" \
    "<input name='value' type='color3' value='0.5, 0.2, 0.1'/></constant>" \
    "<image name='map' type='color3'><input name='file' type='filename' value='a.png'/></image>" \
    "<constant name='number' type='float'/></nodegraph>" \
    "<nodegraph name='linear' colorspace='lin_rec709'/>"

struct fixture {
    mxg_context *context;
    mxg_library *library;
    mxg_document *srgb, *acescg, *plain;
};

static mxg_document *parse(const struct fixture *f, const char *text)
{
    mxg_document *document = NULL;
    REQUIRE_EQ(
        mxg_document_parse(f->context, f->library, "text.mtlx", text, strlen(text), &document),
        MXG_OK);
    return document;
}

/* The value of an attribute that the element itself has; "-": it has none. */
static const char *own_attribute(const mxg_document *document, const char *path, const char *name)
{
    mxg_attribute attribute = MXG_INIT(mxg_attribute);
    mxg_element element = element_at(document, path);
    uint32_t index = mxg_document_find_attribute(document, element, name);
    REQUIRE(element);
    return mxg_document_attribute(document, element, index, &attribute) == MXG_OK ? attribute.value
                                                                                  : "-";
}

static mxg_document *copied(const struct fixture *f, const mxg_document *to,
                            const mxg_document *from, const char *path)
{
    mxg_edit *edit = NULL;
    mxg_document *after = NULL;
    REQUIRE_EQ(mxg_edit_create(f->context, f->library, to, NULL, &edit), MXG_OK);
    REQUIRE(mxg_edit_copy_element(edit, 0, from, element_at(from, path), "copy"));
    REQUIRE_EQ(commit(edit, &after), MXG_OK);
    return after;
}

static void test_copies(const struct fixture *f)
{
    mxg_document *after = copied(f, f->acescg, f->srgb, "G");
    REQUIRE_STR(own_attribute(after, "copy", "colorspace"), "srgb_texture");
    REQUIRE_STR(own_attribute(after, "copy", "fileprefix"), "own/");
    mxg_document_destroy(after);
    after = copied(f, f->acescg, f->plain, "G/tint");
    REQUIRE_STR(own_attribute(after, "copy", "colorspace"), "none");
    REQUIRE_STR(own_attribute(after, "copy", "fileprefix"), "-");
    mxg_document_destroy(after);
    after = copied(f, f->plain, f->srgb, "G/map");
    REQUIRE_STR(own_attribute(after, "copy", "fileprefix"), "own/");
    REQUIRE_STR(own_attribute(after, "copy", "colorspace"), "srgb_texture");
    mxg_document_destroy(after);
    after = copied(f, f->acescg, f->srgb, "G/number"); /* has no colours */
    REQUIRE_STR(own_attribute(after, "copy", "colorspace"), "-");
    mxg_document_destroy(after);
    after = copied(f, f->srgb, f->srgb, "G/tint"); /* the same space is around it */
    REQUIRE_STR(own_attribute(after, "copy", "colorspace"), "-");
    mxg_document_destroy(after);
}

/* Each element that names geometry keeps the prefix of these names; others need none. */
static void test_geometry(const struct fixture *f)
{
    static const struct {
        const char *element, *prefix;
    } rows[] = {
        {"<collection name='c' includegeom='a'/>", "/x/"},
        {"<collection name='c' includegeom='/a' excludegeom='a'/>", "/x/"},
        {"<collection name='c' excludegeom='a'/>", "/x/"},
        {"<collection name='c' includecollection='d'/>", "-"},
        {"<look name='c'><visibility name='v' geom='a'/></look>", "/x/"},
        {"<look name='c'><visibility name='v' collection='d' viewergeom='a'/></look>", "/x/"},
        {"<geominfo name='c' geom='a'/>", "/x/"},
        {"<propertyset name='c'><property name='p' type='geomname' value='a'/></propertyset>",
         "/x/"},
        {"<propertyset name='c'><property name='p' type='geomnamearray' "
         "value='a,b'/></propertyset>",
         "/x/"},
        {"<propertyset name='c'><property name='p' type='float' value='1'/></propertyset>", "-"},
        {"<collection name='c' geomprefix='/own/' includegeom='a'/>", "/own/"},
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[512];
        snprintf(text, sizeof text, HEAD " geomprefix='/x/'>%s</materialx>", rows[i].element);
        mxg_document *from = parse(f, text), *after = copied(f, f->acescg, from, "c");
        REQUIRE_STR(own_attribute(after, "copy", "geomprefix"), rows[i].prefix);
        mxg_document_destroy(from);
        mxg_document_destroy(after);
    }
}

static void test_moves(const struct fixture *f)
{
    mxg_edit *edit = NULL;
    mxg_document *after = NULL;
    REQUIRE_EQ(mxg_edit_create(f->context, f->library, f->srgb, NULL, &edit), MXG_OK);
    REQUIRE_EQ(mxg_edit_move_element(edit, edited_at(edit, "G/tint"), edited_at(edit, "linear"), 0),
               MXG_OK);
    REQUIRE_EQ(mxg_edit_move_element(edit, edited_at(edit, "G/map"), 0, 0), MXG_OK);
    REQUIRE_EQ(commit(edit, &after), MXG_OK);
    REQUIRE_STR(own_attribute(after, "linear/tint", "colorspace"), "srgb_texture");
    REQUIRE_STR(own_attribute(after, "map", "fileprefix"), "own/");
    REQUIRE_STR(own_attribute(after, "map", "colorspace"), "-");
    mxg_document_destroy(after);
}

int main(void)
{
    struct fixture f;
    REQUIRE_EQ(mxg_context_create(NULL, &f.context), MXG_OK);
    f.library = mxg_library_builtin(f.context);
    f.srgb = parse(&f, HEAD " colorspace='srgb_texture'>" GRAPH "</materialx>");
    f.acescg = parse(&f, HEAD " colorspace='acescg'></materialx>");
    f.plain = parse(&f, HEAD ">" GRAPH "</materialx>");
    test_copies(&f);
    test_geometry(&f);
    test_moves(&f);
    mxg_document_destroy(f.srgb);
    mxg_document_destroy(f.acescg);
    mxg_document_destroy(f.plain);
    mxg_library_unref(f.library);
    mxg_context_destroy(f.context);
    return test_report("api-edit_scope");
}
