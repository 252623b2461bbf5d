// SPDX-License-Identifier: Apache-2.0
/*
 * Calls of the public interface in any order: each byte pair is a call and its argument; objects
 * live in a few slots. Arguments may be wrong (NULL, indices too large, names of nothing); the
 * interface says so and goes on.
 */
#include "files.h"

enum { NUM_SLOTS = 3 };

struct machine {
    mxg_context *context;
    mxg_library *libraries[NUM_SLOTS];
    mxg_document *documents[NUM_SLOTS];
    mxg_options *options[NUM_SLOTS];
    mxg_result *results[NUM_SLOTS];
};

static const char parts[] =
    "<materialx version='1.39'><include xmlns='http://www.w3.org/2001/XInclude' href='lib.mtlx'/>"
    "<nodegraph name='G'><input name='k' type='float' value='2'/><image name='i' type='color3'>"
    "<input name='file' type='filename' value='a.png'/></image><multiply name='m' type='color3'>"
    "<input name='in1' type='color3' nodename='i'/><input name='in2' type='float' "
    "interfacename='k'/></multiply>"
    "<output name='out' type='color3' nodename='m'/></nodegraph>"
    "<standard_surface name='S' type='surfaceshader'><input name='base_color' type='color3' "
    "nodegraph='G'/>"
    "<input name='coat' type='float' value='0.5'/></standard_surface>"
    "<surfacematerial name='M' type='material'><input name='surfaceshader' type='surfaceshader' "
    "nodename='S'/></surfacematerial>"
    "<look name='L'><materialassign name='a' material='M' geom='/'/></look></materialx>"
    "\n== lib.mtlx\n<materialx version='1.39'><nodedef name='ND_t' node='t'><input name='in' "
    "type='float' value='1'/>"
    "<output name='out' type='float'/></nodedef><implementation name='IM_t' nodedef='ND_t' "
    "sourcecode='{{in}} * 3.0'/></materialx>"
    "\n== bad.mtlx\n<materialx version='1.39'><t name='x' type='float'><input name='in' "
    "type='floot' nodename='y'/></t>";

static const char *const names[] = {
    "main.mtlx", "lib.mtlx", "bad.mtlx", "none.mtlx", "M",    "G/out", "L",         "S",
    "",          "nothing",  "glsl",     "vulkan",    "essl", "osl",   "interface", "reduced"};

static const char *name_of(unsigned argument)
{
    return argument % 17 == 16 ? NULL : names[argument % 17];
}

static void load_library(struct machine *m, unsigned slot, unsigned argument)
{
    const char *path = name_of(argument);
    mxg_library *base = argument & 32 ? NULL : m->libraries[argument / 64 % NUM_SLOTS];
    mxg_library *made = NULL;
    mxg_library_load(m->context, base, &path, argument & 16 ? 0 : 1, &made);
    mxg_library_unref(m->libraries[slot]);
    m->libraries[slot] = made;
}

static void take_builtin(struct machine *m, unsigned slot, unsigned argument)
{
    (void)argument;
    mxg_library_unref(m->libraries[slot]);
    m->libraries[slot] = mxg_library_builtin(m->context);
}

static void share_library(struct machine *m, unsigned slot, unsigned argument)
{
    mxg_library *shared = mxg_library_ref(m->libraries[argument % NUM_SLOTS]);
    mxg_library_unref(m->libraries[slot]);
    m->libraries[slot] = shared;
}

static void drop_library(struct machine *m, unsigned slot, unsigned argument)
{
    (void)argument;
    mxg_library_unref(m->libraries[slot]);
    m->libraries[slot] = NULL;
}

static void load_document(struct machine *m, unsigned slot, unsigned argument)
{
    mxg_document_destroy(m->documents[slot]);
    mxg_document_load(m->context, m->libraries[argument / 16 % NUM_SLOTS], name_of(argument % 16),
                      &m->documents[slot]);
}

static void drop_document(struct machine *m, unsigned slot, unsigned argument)
{
    (void)argument;
    mxg_document_destroy(m->documents[slot]);
    m->documents[slot] = NULL;
}

static void make_options(struct machine *m, unsigned slot, unsigned argument)
{
    (void)argument;
    mxg_options_destroy(m->options[slot]);
    mxg_options_create(m->context, &m->options[slot]);
}

static void set_option(struct machine *m, unsigned slot, unsigned argument)
{
    mxg_option option = {sizeof option};
    mxg_get_option(argument, &option);
    mxg_options_set(m->options[slot], argument & 128 ? name_of(argument) : option.key,
                    name_of(argument / 2));
    if (m->options[slot])
        mxg_options_error(m->options[slot]);
}

static void generate(struct machine *m, unsigned slot, unsigned argument)
{
    mxg_generate_desc desc = {sizeof desc, name_of(10 + argument % 7), name_of(argument / 7),
                              m->options[argument % NUM_SLOTS]};
    mxg_result_destroy(m->results[slot]);
    mxg_generate(m->context, m->documents[argument / 3 % NUM_SLOTS], argument & 128 ? NULL : &desc,
                 &m->results[slot]);
}

static void validate(struct machine *m, unsigned slot, unsigned argument)
{
    mxg_result_destroy(m->results[slot]);
    mxg_document_validate(m->context, m->documents[argument % NUM_SLOTS], &m->results[slot]);
}

static void inspect(struct machine *m, unsigned slot, unsigned argument)
{
    mxg_generate_desc desc = {sizeof desc, "glsl", name_of(argument), m->options[0]};
    mxg_result_destroy(m->results[slot]);
    mxg_inspect(m->context, m->documents[argument % NUM_SLOTS], (mxg_view)(argument / 8 % 8), &desc,
                &m->results[slot]);
    mxg_result_text(m->results[slot], NULL);
}

static void read_result(struct machine *m, unsigned slot, unsigned argument)
{
    const mxg_result *result = m->results[slot];
    mxg_variable variable = {sizeof variable};
    mxg_shader_info info = {sizeof info};
    mxg_compiled_input input = {sizeof input};
    mxg_diagnostic diagnostic = {sizeof diagnostic};
    const char *file, *path;
    uint32_t line, column;
    char text[80];
    mxg_result_source(result, (mxg_stage)(argument % 3), NULL);
    mxg_result_closure_path(result, argument, text, argument % sizeof text);
    mxg_result_source_place(result, (mxg_stage)(argument % 3), argument, &file, &line, &column,
                            &path);
    mxg_result_variable(result, argument, &variable);
    mxg_result_find_variable(result, name_of(argument), &line);
    mxg_result_compiled_input(result, argument, &input);
    mxg_result_info(result, &info);
    mxg_result_reflection_json(result, NULL);
    mxg_diagnostics_get(mxg_result_diagnostics(result), argument, &diagnostic);
    mxg_diagnostics_format(mxg_result_diagnostics(result), argument, parts, argument, true, text,
                           argument % sizeof text);
}

static void read_document(struct machine *m, unsigned slot, unsigned argument)
{
    const mxg_document *document = m->documents[slot];
    mxg_renderable renderable = {sizeof renderable};
    mxg_document_file(document, argument);
    mxg_document_renderable(document, argument, &renderable);
    mxg_document_look_material(document, name_of(argument), argument / 32, &renderable);
    mxg_diagnostics_errors(mxg_document_diagnostics(document));
}

static void read_library(struct machine *m, unsigned slot, unsigned argument)
{
    mxg_library *library = m->libraries[slot];
    const void *data;
    const char *text;
    size_t size;
    mxg_nodedef def = {sizeof def};
    mxg_port port = {sizeof port};
    mxg_library_nodedef(library, argument * 7, &def);
    mxg_library_file(library, argument);
    mxg_library_port(library, argument * 7, argument % 32, &port);
    mxg_library_supports(library, argument * 7, name_of(argument));
    mxg_library_image(library, &data, &size);
    if (argument > 250)
        mxg_library_expand(library, &text, &size);
}

static void (*const calls[])(struct machine *, unsigned slot, unsigned argument) = {
    load_library,  take_builtin, share_library, drop_library, load_document,
    drop_document, make_options, set_option,    generate,     validate,
    inspect,       read_result,  read_document, read_library};
enum { NUM_CALLS = sizeof calls / sizeof *calls, MAX_CALLS = 64 };

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    struct machine m = {0};
    struct fuzz_files files;
    fuzz_files_split(&files, parts, sizeof parts - 1);
    m.context =
        fuzz_files_context(&files, heap, (mxg_context_desc){.max_memory = (size_t)64 << 20});
    for (size_t i = 0; i + 1 < size && i < 2 * MAX_CALLS; i += 2) {
        unsigned call = (unsigned char)data[i], argument = (unsigned char)data[i + 1];
        calls[call % NUM_CALLS](&m, call / NUM_CALLS % NUM_SLOTS, argument);
    }
    for (int i = 0; i < NUM_SLOTS; i++) {
        mxg_library_unref(m.libraries[i]);
        mxg_document_destroy(m.documents[i]);
        mxg_options_destroy(m.options[i]);
        mxg_result_destroy(m.results[i]);
    }
    mxg_context_destroy(m.context);
    FUZZ_REQUIRE(files.num_open == 0);
}
