// SPDX-License-Identifier: Apache-2.0
/* Every public function: what it gives, and what it says to arguments that are wrong. */
#include "documents.h"

static struct memory_files files = {.files = documents};

struct objects {
    mxg_context *context;
    mxg_library *library;
    mxg_document *document;
    mxg_options *options;
    mxg_result *result;
};

static struct objects make_objects(void)
{
    struct objects o = {0};
    mxg_resolver resolver = memory_resolver(&files);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.resolver = &resolver;
    REQUIRE_EQ(mxg_context_create(&desc, &o.context), MXG_OK);
    o.library = mxg_library_builtin(o.context);
    REQUIRE_EQ(mxg_document_load(o.context, o.library, "main.mtlx", &o.document), MXG_OK);
    REQUIRE_EQ(mxg_options_create(o.context, &o.options), MXG_OK);
    mxg_generate_desc generate = {sizeof generate, "vulkan", NULL, o.options};
    REQUIRE_EQ(mxg_generate(o.context, o.document, &generate, &o.result), MXG_OK);
    return o;
}

static void destroy_objects(struct objects *o)
{
    mxg_result_destroy(o->result);
    mxg_options_destroy(o->options);
    mxg_document_destroy(o->document);
    mxg_library_unref(o->library);
    mxg_context_destroy(o->context);
}

static void test_versions(void)
{
    char text[32];
    snprintf(text, sizeof text, "%d.%d.%d", MXG_VERSION_MAJOR, MXG_VERSION_MINOR,
             MXG_VERSION_PATCH);
    REQUIRE_STR(mxg_version_string(), text);
    for (int status = MXG_OK; status <= MXG_ERROR_CANCELLED + 1; status++)
        REQUIRE(*mxg_status_string((mxg_status)status));
}

/* ---- Structs that begin with their size ---- */

static void test_desc_sizes(void)
{
    struct {
        mxg_context_desc desc;
        size_t later; /* of a newer version of the header */
    } newer = {{sizeof newer}, 0};
    mxg_context *context = NULL;
    REQUIRE_EQ(mxg_context_create(NULL, &context), MXG_OK);
    mxg_context_destroy(context);
    REQUIRE_EQ(mxg_context_create(&newer.desc, &context), MXG_OK);
    mxg_context_destroy(context);
    newer.later = 1; /* asks for what this version does not know */
    REQUIRE_EQ(mxg_context_create(&newer.desc, &context), MXG_ERROR_ARGUMENT);
    REQUIRE(!context);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.size = 0;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_ERROR_ARGUMENT);
    desc.size = sizeof desc.size + sizeof desc.realloc; /* an older one was shorter */
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_OK);
    mxg_context_destroy(context);
    REQUIRE_EQ(mxg_context_create(NULL, NULL), MXG_ERROR_ARGUMENT);
    mxg_resolver half = {.open = memory_open};
    desc = (mxg_context_desc)MXG_CONTEXT_DESC_INIT;
    desc.resolver = &half;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_ERROR_ARGUMENT);
}

static void test_out_sizes(void)
{
    struct {
        mxg_target target;
        char later[16];
    } newer = {{sizeof newer}, "not yet cleared"};
    REQUIRE_EQ(mxg_catalogue_target(0, &newer.target), MXG_OK);
    REQUIRE_STR(newer.later, "");
    mxg_target target = {offsetof(mxg_target, brief)};
    target.brief = "stays";
    REQUIRE_EQ(mxg_catalogue_target(0, &target), MXG_OK);
    REQUIRE_STR(target.brief, "stays");
    REQUIRE_STR(target.name, newer.target.name);
    target.size = 0;
    REQUIRE_EQ(mxg_catalogue_target(0, &target), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_catalogue_target(0, NULL), MXG_ERROR_ARGUMENT);
}

/* ---- NULL, and indices out of range ---- */

#define REFUSED(call) REQUIRE_EQ((call), MXG_ERROR_ARGUMENT)

static void test_refused_objects(const struct objects *o)
{
    mxg_library *library = NULL;
    mxg_document *document = NULL;
    mxg_options *options = NULL;
    const char *null_path[] = {NULL}, *path = "tint.mtlx";
    REQUIRE(!mxg_library_builtin(NULL));
    REFUSED(mxg_library_load(NULL, o->library, &path, 1, &library));
    REFUSED(mxg_library_load(o->context, o->library, null_path, 1, &library));
    REFUSED(mxg_library_load(o->context, o->library, NULL, 1, &library));
    REFUSED(mxg_library_load(o->context, o->library, &path, 1, NULL));
    REFUSED(mxg_document_load(NULL, o->library, "main.mtlx", &document));
    REFUSED(mxg_document_load(o->context, NULL, "main.mtlx", &document));
    REFUSED(mxg_document_load(o->context, o->library, NULL, &document));
    REFUSED(mxg_document_load(o->context, o->library, "main.mtlx", NULL));
    REFUSED(mxg_scene_load(o->context, "main.usda", NULL, NULL));
    REFUSED(mxg_scene_parse(o->context, "main.usda", "", 0, NULL, NULL));
    REFUSED(mxg_document_parse(o->context, o->library, NULL, "", 0, &document));
    REFUSED(mxg_document_parse(o->context, o->library, "x.mtlx", NULL, 1, &document));
    REFUSED(mxg_options_create(NULL, &options));
    REFUSED(mxg_options_create(o->context, NULL));
    REFUSED(mxg_options_set(NULL, "names", "path"));
    REFUSED(mxg_options_set(o->options, NULL, "path"));
    REFUSED(mxg_options_set(o->options, "names", NULL));
    REQUIRE(!library && !document && !options);
}

static void test_refused_calls(const struct objects *o)
{
    mxg_result *result = NULL;
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    REFUSED(mxg_generate(o->context, o->document, &desc, &result)); /* no target */
    REFUSED(mxg_inspect(o->context, o->document, MXG_VIEW_IR, &desc, &result));
    REFUSED(mxg_inspect(o->context, o->document, MXG_VIEW_IR, NULL, &result));
    desc.target = "glsl";
    REFUSED(mxg_generate(NULL, o->document, &desc, &result));
    REFUSED(mxg_generate(o->context, NULL, &desc, &result));
    REFUSED(mxg_generate(o->context, o->document, NULL, &result));
    REFUSED(mxg_generate(o->context, o->document, &desc, NULL));
    REFUSED(mxg_inspect(o->context, o->document, (mxg_view)99, &desc, &result));
    REFUSED(mxg_inspect(o->context, NULL, MXG_VIEW_ELEMENTS, NULL, &result));
    REFUSED(mxg_validate(o->context, NULL, &result));
    REFUSED(mxg_validate(NULL, o->document, &result));
    REFUSED(mxg_validate(o->context, o->document, NULL));
    desc.target = "glsl";
    desc.size = 0;
    REFUSED(mxg_generate(o->context, o->document, &desc, &result));
    REQUIRE(!result);
}

static void test_refused_indices(const struct objects *o)
{
    mxg_nodedef nodedef = {sizeof nodedef};
    mxg_port port = {sizeof port};
    mxg_renderable renderable = {sizeof renderable};
    mxg_target target = {sizeof target};
    mxg_option option = {sizeof option};
    mxg_variable variable = {sizeof variable};
    mxg_compiled_input input = {sizeof input};
    mxg_diagnostic diagnostic = {sizeof diagnostic};
    REFUSED(mxg_library_nodedef(o->library, mxg_library_num_nodedefs(o->library), &nodedef));
    REFUSED(mxg_library_port(o->library, mxg_library_num_nodedefs(o->library), 0, &port));
    REFUSED(mxg_library_port(o->library, 0, 1000, &port));
    mxg_implementation implementation = {sizeof implementation};
    REFUSED(mxg_library_implementation(o->library, mxg_library_num_nodedefs(o->library), 0,
                                       &implementation));
    REFUSED(mxg_library_implementation(o->library, 0, 1000, &implementation));
    REQUIRE_EQ(mxg_library_num_implementations(NULL, 0), 0);
    REQUIRE_EQ(mxg_document_num_implementations(NULL, 0), 0);
    REFUSED(mxg_document_renderable(o->document, mxg_document_num_renderables(o->document),
                                    &renderable));
    REFUSED(mxg_catalogue_target(mxg_catalogue_num_targets(), &target));
    REFUSED(mxg_catalogue_option(mxg_catalogue_num_options(), &option));
    REFUSED(mxg_result_variable(o->result, mxg_result_num_variables(o->result), &variable));
    REFUSED(
        mxg_result_compiled_input(o->result, mxg_result_num_compiled_inputs(o->result), &input));
    REFUSED(mxg_diagnostics_item(mxg_result_diagnostics(o->result), 1000, &diagnostic));
    REQUIRE(!mxg_document_file(o->document, mxg_document_num_files(o->document)));
    REQUIRE(!mxg_result_source(o->result, MXG_NUM_STAGES, NULL));
    mxg_place place = {sizeof place};
    REFUSED(mxg_result_source_place(o->result, MXG_STAGE_PIXEL, 100000, &place));
    REQUIRE_EQ(mxg_result_source_path(o->result, MXG_STAGE_PIXEL, 100000, NULL, 0), 0);
    REQUIRE_EQ(mxg_result_source_path(o->result, MXG_NUM_STAGES, 1, NULL, 0), 0);
    REQUIRE_EQ(mxg_result_source_path(NULL, MXG_STAGE_PIXEL, 1, NULL, 0), 0);
    REQUIRE_EQ(mxg_result_source_path(NULL, MXG_STAGE_PIXEL, 1, NULL, 8), 0);
    size_t only = sizeof only; /* a description without anything behind its size */
    REQUIRE_EQ(mxg_generate(NULL, NULL, (const void *)&only, NULL), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_diagnostics_format(NULL, 0, NULL, 0, false, NULL, 8), 0);
}

/* Accessors of NULL are of something empty, and NULL can be destroyed. */
static void test_null_objects(void)
{
    size_t size = 1;
    mxg_shader_info info = {sizeof info};
    mxg_context_destroy(NULL);
    mxg_library_unref(NULL);
    mxg_document_destroy(NULL);
    mxg_options_destroy(NULL);
    mxg_result_destroy(NULL);
    REQUIRE(!mxg_library_ref(NULL));
    REQUIRE_EQ(mxg_options_error(NULL, NULL, 0) + mxg_edit_error(NULL, NULL, 0), 0);
    REQUIRE(!mxg_library_diagnostics(NULL) && !mxg_document_diagnostics(NULL)
            && !mxg_result_diagnostics(NULL));
    REQUIRE_EQ(mxg_diagnostics_num_items(NULL) + mxg_diagnostics_num_errors(NULL), 0);
    REQUIRE_EQ(mxg_diagnostics_format(NULL, 0, NULL, 0, false, NULL, 0), 0);
    REQUIRE_EQ(mxg_library_num_nodedefs(NULL) + mxg_document_num_files(NULL)
                   + mxg_document_num_renderables(NULL),
               0);
    REQUIRE_EQ(mxg_result_num_variables(NULL) + mxg_result_num_compiled_inputs(NULL), 0);
    REQUIRE(mxg_result_find_variable(NULL, "S/coat") == MXG_NONE);
    REQUIRE(!mxg_result_source(NULL, MXG_STAGE_PIXEL, &size) && size == 0);
    REQUIRE(!mxg_result_reflection_json(NULL, &size) && !mxg_result_text(NULL, &size) && size == 0);
    REFUSED(mxg_result_info(NULL, &info));
    REFUSED(mxg_library_image(NULL, NULL, NULL));
    REQUIRE(!mxg_library_xml(NULL, NULL));
    REQUIRE(!mxg_library_losses(NULL));
}

/* ---- What they give ---- */

static void test_library(const struct objects *o)
{
    static const char *const paths[] = {"tint.mtlx"};
    mxg_library *layer = NULL, *alone = NULL, *image = NULL;
    REQUIRE_EQ(mxg_library_load(o->context, o->library, paths, 1, &layer), MXG_OK);
    REQUIRE_EQ(mxg_library_num_nodedefs(layer), mxg_library_num_nodedefs(o->library) + 1);
    mxg_nodedef nodedef = {sizeof nodedef};
    REQUIRE_EQ(mxg_library_nodedef(layer, mxg_library_num_nodedefs(layer) - 1, &nodedef), MXG_OK);
    REQUIRE_STR(nodedef.name, "ND_tint");
    REQUIRE_STR(nodedef.node, "tint");
    REQUIRE_STR(nodedef.file, "tint.mtlx");
    REQUIRE(nodedef.num_inputs == 2 && nodedef.num_outputs == 1 && nodedef.has_implementation);
    mxg_port port = {sizeof port};
    REQUIRE_EQ(mxg_library_port(layer, mxg_library_num_nodedefs(layer) - 1, 1, &port), MXG_OK);
    REQUIRE_STR(port.name, "by");
    REQUIRE_STR(port.type, "float");
    REQUIRE_STR(port.value, "1");
    const void *data = NULL;
    size_t size = 0;
    REFUSED(mxg_library_image(layer, &data, &size)); /* it stands on another */
    REQUIRE_EQ(mxg_library_image(o->library, &data, &size), MXG_OK);
    REQUIRE(data && size > 100000);
    REQUIRE_EQ(mxg_library_load(o->context, NULL, paths, 1, &alone), MXG_OK);
    REQUIRE_EQ(mxg_library_num_nodedefs(alone), 1);
    REQUIRE_EQ(mxg_library_image(alone, &data, &size), MXG_OK);
    REQUIRE(data && size);
    const char *text = mxg_library_xml(alone, &size);
    REQUIRE(text && strlen(text) == size && strstr(text, "ND_tint"));
    REQUIRE(mxg_library_losses(alone) && mxg_diagnostics_num_items(mxg_library_losses(alone)) == 0);
    REQUIRE(has_diagnostic(mxg_library_losses(o->library), "expand-loss"));
    REQUIRE(mxg_library_ref(alone) == alone);
    mxg_library_unref(alone);
    static const char *const missing[] = {"none.mxlib"};
    REQUIRE_EQ(mxg_library_load(o->context, NULL, missing, 1, &image), MXG_ERROR_DOCUMENT);
    REQUIRE(has_diagnostic(mxg_library_diagnostics(image), "file-missing"));
    mxg_document *document = NULL; /* a faulty library is refused as a base */
    REFUSED(mxg_document_load(o->context, image, "main.mtlx", &document));
    mxg_library *none = NULL;
    REFUSED(mxg_library_load(o->context, image, paths, 1, &none));
    mxg_library_unref(image);
    mxg_library_unref(alone);
    mxg_library_unref(layer);
}

static void test_document(const struct objects *o)
{
    static const char *const names[] = {"main.mtlx", "tint.mtlx", "tint.glsl", "curve.glsl"};
    REQUIRE_EQ(mxg_document_num_files(o->document), 4);
    for (uint32_t i = 0; i < mxg_document_num_files(o->document) && i < 4; i++)
        REQUIRE_STR(mxg_document_file(o->document, i), names[i]);
    REQUIRE_EQ(mxg_document_num_renderables(o->document), 1);
    mxg_renderable renderable = {sizeof renderable};
    REQUIRE_EQ(mxg_document_renderable(o->document, 0, &renderable), MXG_OK);
    REQUIRE_STR(renderable.path, "M");
    REQUIRE_STR(renderable.type, "material");
    REQUIRE_STR(renderable.category, "surfacematerial");
    mxg_result *result = NULL;
    REQUIRE_EQ(mxg_validate(o->context, o->document, &result), MXG_OK);
    REQUIRE_EQ(mxg_diagnostics_num_items(mxg_result_diagnostics(result)), 0);
    mxg_result_destroy(result);
    mxg_document *bad = NULL;
    REQUIRE_EQ(mxg_document_parse(o->context, o->library, "bad.mtlx", "<nothing/>", 10, &bad),
               MXG_ERROR_DOCUMENT);
    REQUIRE(bad && has_diagnostic(mxg_document_diagnostics(bad), "xml-root"));
    mxg_generate_desc desc = {sizeof desc, "glsl", NULL, NULL};
    REQUIRE_EQ(mxg_generate(o->context, bad, &desc, &result), MXG_ERROR_DOCUMENT);
    REQUIRE(result && !mxg_result_source(result, MXG_STAGE_PIXEL, NULL));
    mxg_result_destroy(result);
    mxg_document_destroy(bad);
    REQUIRE_EQ(mxg_document_parse(o->context, o->library, "empty.mtlx", NULL, 0, &bad),
               MXG_ERROR_DOCUMENT);
    mxg_document_destroy(bad);
}

static void test_diagnostics(const struct objects *o)
{
    static const char text[] =
        "<materialx version=\"1.39\">\n  <ad name=\"a\" type=\"float\"/>\n</materialx>";
    mxg_document *document = NULL;
    mxg_result *result = NULL;
    mxg_document_parse(o->context, o->library, "typo.mtlx", text, strlen(text), &document);
    REQUIRE_EQ(mxg_validate(o->context, document, &result), MXG_ERROR_DOCUMENT);
    const mxg_diagnostics *list = mxg_result_diagnostics(result);
    mxg_diagnostic first = {sizeof first};
    REQUIRE_EQ(mxg_diagnostics_num_errors(list), 1);
    REQUIRE_EQ(mxg_diagnostics_item(list, 0, &first), MXG_OK);
    REQUIRE(first.severity == MXG_SEVERITY_ERROR && first.line == 2 && first.column == 3
            && first.parent == 0);
    REQUIRE_STR(first.id, "unknown-node");
    REQUIRE_STR(first.file, "typo.mtlx");
    char whole[512], part[20];
    const char *line = strchr(text, '\n') + 1;
    size_t size = strcspn(line, "\n"),
           len = mxg_diagnostics_format(list, 0, line, size, false, whole, sizeof whole);
    REQUIRE_EQ(strlen(whole), len);
    REQUIRE(strstr(whole, "typo.mtlx:2:3: error: ") == whole && strchr(whole, '^'));
    REQUIRE(len && whole[len - 1] != '\n');
    REQUIRE_EQ(mxg_diagnostics_format(list, 0, line, size, false, part, sizeof part), len);
    REQUIRE(strlen(part) == sizeof part - 1 && strncmp(part, whole, sizeof part - 1) == 0);
    REQUIRE_EQ(mxg_diagnostics_format(list, 0, line, size, false, NULL, 0), len);
    REQUIRE(mxg_diagnostics_format(list, 0, line, size, true, NULL, 0) > len);
    mxg_result_destroy(result);
    mxg_document_destroy(document);
}

static void test_options(const struct objects *o)
{
    for (uint32_t i = 0; i < mxg_catalogue_num_options(); i++) {
        mxg_option option = {sizeof option};
        REQUIRE_EQ(mxg_catalogue_option(i, &option), MXG_OK);
        REQUIRE(*option.key && *option.doc);
        /* every default is a value */
        REQUIRE_EQ(mxg_options_set(o->options, option.key, option.initial), MXG_OK);
    }
    static const char wanted[] =
        "'1025' is not a value of option 'max-lights'; expected an integer of 0..1024";
    char reason[256], part[8];
    REFUSED(mxg_options_set(o->options, "max-lights", "1025"));
    REQUIRE_EQ(mxg_options_error(o->options, reason, sizeof reason), sizeof wanted - 1);
    REQUIRE_STR(reason, wanted);
    REQUIRE_EQ(mxg_options_error(o->options, part, sizeof part), sizeof wanted - 1);
    REQUIRE_STR(part, "'1025' ");
    REFUSED(mxg_options_set(o->options, "max-lights", "3x"));
    REFUSED(mxg_options_set(o->options, "comments", "yes"));
    REFUSED(mxg_options_set(o->options, "interface", "complet"));
    REFUSED(mxg_options_set(o->options, "interfac", "complete"));
    mxg_options_error(o->options, reason, sizeof reason);
    REQUIRE(strstr(reason, "interface"));
    REQUIRE_EQ(mxg_options_set(o->options, "interface", "reduced"), MXG_OK);
    REQUIRE_EQ(mxg_options_error(o->options, reason, sizeof reason), 0);
    REQUIRE_STR(reason, "");
}

int main(void)
{
    test_versions();
    test_desc_sizes();
    test_out_sizes();
    test_null_objects();
    struct objects o = make_objects();
    test_refused_objects(&o);
    test_refused_calls(&o);
    test_refused_indices(&o);
    test_library(&o);
    test_document(&o);
    test_diagnostics(&o);
    test_options(&o);
    destroy_objects(&o);
    REQUIRE_EQ(files.num_open, 0);
    return test_report("api-calls");
}
