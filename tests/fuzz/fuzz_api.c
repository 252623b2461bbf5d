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
    mxg_edit *edits[NUM_SLOTS];
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
    mxg_catalogue_option(argument, &option);
    mxg_options_set(m->options[slot], argument & 128 ? name_of(argument) : option.key,
                    name_of(argument / 2));
    char reason[40];
    mxg_options_error(m->options[slot], reason, argument % sizeof reason);
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
    mxg_validate(m->context, m->documents[argument % NUM_SLOTS], &m->results[slot]);
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
    mxg_place place = {sizeof place};
    mxg_storage storage = {sizeof storage};
    char text[80];
    mxg_result_source(result, (mxg_stage)(argument % 3), NULL);
    mxg_result_closure_path(result, argument, text, argument % sizeof text);
    mxg_result_source_place(result, (mxg_stage)(argument % 3), argument, &place);
    mxg_result_storage(result, &storage);
    mxg_result_variable(result, argument, &variable);
    mxg_result_find_variable(result, name_of(argument));
    mxg_result_compiled_input(result, argument, &input);
    mxg_result_info(result, &info);
    mxg_result_reflection_json(result, NULL);
    mxg_diagnostics_item(mxg_result_diagnostics(result), argument, &diagnostic);
    mxg_diagnostics_format(mxg_result_diagnostics(result), argument, parts, argument, true, text,
                           argument % sizeof text);
}

static void read_document(struct machine *m, unsigned slot, unsigned argument)
{
    const mxg_document *document = m->documents[slot];
    mxg_renderable renderable = {sizeof renderable};
    mxg_document_file(document, argument);
    mxg_document_renderable(document, argument, &renderable);
    mxg_document_has_assignment(document, name_of(argument), argument / 32);
    mxg_diagnostics_num_errors(mxg_document_diagnostics(document));
}

static void read_library(struct machine *m, unsigned slot, unsigned argument)
{
    mxg_library *library = m->libraries[slot];
    const void *data;
    size_t size;
    mxg_nodedef def = {sizeof def};
    mxg_port port = {sizeof port};
    mxg_library_nodedef(library, argument * 7, &def);
    mxg_library_file(library, argument);
    mxg_library_port(library, argument * 7, argument % 32, &port);
    mxg_library_has_implementation(library, argument * 7, name_of(argument));
    mxg_library_image(library, &data, &size);
    if (argument > 250)
        mxg_library_xml(library, &size);
}

static void begin_edit(struct machine *m, unsigned slot, unsigned argument)
{
    mxg_edit_destroy(m->edits[slot]);
    m->edits[slot] = NULL;
    mxg_edit_create(m->context, m->libraries[argument % NUM_SLOTS],
                    argument & 128 ? NULL : m->documents[argument / 4 % NUM_SLOTS],
                    name_of(argument), &m->edits[slot]);
}

static void change_names(mxg_edit *edit, mxg_element element, mxg_element other, unsigned argument)
{
    switch (argument % 6) {
    case 0: mxg_edit_rename_element(edit, element, name_of(argument / 3)); break;
    case 1: mxg_edit_set_attribute(edit, element, "name", name_of(argument / 3)); break;
    case 2: mxg_edit_set_attribute(edit, element, "nodedef", name_of(argument / 3)); break;
    case 3: mxg_edit_remove_element(edit, element); break;
    case 4: mxg_edit_move_element(edit, element, other, argument / 8 % 40); break;
    default:
        mxg_edit_set_attribute(edit, element, argument & 64 ? "namespace" : "doc",
                               argument & 32 ? NULL : "x");
    }
}

static void change_edit(struct machine *m, unsigned slot, unsigned argument)
{
    static const char *const paths[] = {"S", "M", "G", "G/m", "G/i", "new", "L", ""};
    mxg_edit *edit = m->edits[slot];
    const float values[] = {0.5f, 0.25f, 1.0f};
    mxg_element element = mxg_edit_find_element(edit, 0, paths[argument % 8]),
                other = mxg_edit_find_element(edit, 0, paths[argument / 8 % 8]);
    switch (argument / 16 % 8) {
    case 0: mxg_edit_set_numbers(edit, element, "base", "float", values, 1 + argument % 2); break;
    case 1:
        mxg_edit_set_value(edit, element, "base_color", "color3", argument & 1 ? "1, 0, 0" : "x");
        break;
    case 2: mxg_edit_connect_input(edit, element, argument & 1 ? "coat" : NULL, other, NULL); break;
    case 3:
        mxg_edit_add_element(edit, other, argument & 1 ? "constant" : "nodegraph", "new", "float");
        break;
    case 4:
        mxg_edit_copy_element(edit, other, m->documents[argument % NUM_SLOTS], argument % 64,
                              argument & 2 ? "copy" : NULL);
        break;
    case 5: mxg_edit_flatten_node(edit, argument & 1 ? element : other); break;
    case 6:
        if (argument & 4)
            mxg_edit_define_nodegraph(edit, element, "ND", argument & 8 ? "group" : "noise2d");
        mxg_edit_group_nodes(edit, (const mxg_element[]){element, other}, 1 + argument % 2,
                             "group");
        break;
    default: change_names(edit, element, other, argument);
    }
    char reason[40];
    mxg_edit_error(edit, reason, argument % sizeof reason);
}

static void end_edit(struct machine *m, unsigned slot, unsigned argument)
{
    mxg_document_destroy(m->documents[slot]);
    m->documents[slot] = NULL;
    mxg_edit_commit(m->edits[argument % NUM_SLOTS], argument & 128 ? NULL : &m->documents[slot]);
    if (argument % 3) {
        mxg_edit_destroy(m->edits[argument % NUM_SLOTS]);
        m->edits[argument % NUM_SLOTS] = NULL;
    }
}

/* The text of a document reads as an equal one. */
static void read_elements(struct machine *m, unsigned slot, unsigned argument)
{
    const mxg_document *document = m->documents[slot];
    mxg_element_info info = {sizeof info};
    mxg_value value = {sizeof value};
    mxg_connection connection = {sizeof connection};
    char path[40];
    mxg_element element = mxg_document_find_element(document, 0, "") + argument;
    mxg_document_element(document, element, &info);
    mxg_document_value(document, element, &value);
    mxg_document_connection(document, element, &connection);
    mxg_document_find_nodedef(document, element);
    mxg_document_find_attribute(document, element, name_of(argument));
    mxg_document_find_element(document, element, name_of(argument));
    mxg_document_element_path(document, element, path, argument % sizeof path);
    mxg_document_xml(document, NULL);
}

static void pack_values(struct machine *m, unsigned slot, unsigned argument)
{
    unsigned char bytes[1024];
    const mxg_result *result = m->results[slot], *other = m->results[argument % NUM_SLOTS];
    mxg_block block = (mxg_block)(argument / 4 % 8);
    mxg_block_info info = {sizeof info};
    mxg_result_block(result, block, &info);
    mxg_result_pack_block(result, NULL, block, bytes, sizeof bytes - argument);
    mxg_result_pack_block(result, m->documents[argument / 32 % NUM_SLOTS], block, bytes,
                          sizeof bytes - argument % 2 * 1000);
    mxg_result_change(result, other, NULL, 0, NULL);
    mxg_result_input_state(result, name_of(argument));
}

static void set_names(struct machine *m, unsigned slot, unsigned argument)
{
    static const char *const settings[][2] = {{"role", "function"},
                                              {"prefix", "a_"},
                                              {"prefix", "_"},
                                              {"rename", "u_viewPosition=eye"},
                                              {"rename", "surface=shade"},
                                              {"rename", "out1=out1,normalWorld=N"},
                                              {"publish", "all"},
                                              {"rename", "G_k=u_frame,u_frame=G_k"},
                                              {"reserved", "N,result"},
                                              {"names", "neutral"},
                                              {"uniform-blocks", "true"},
                                              {"interface", "complete"}};
    unsigned i = argument % (sizeof settings / sizeof *settings);
    mxg_options_set(m->options[slot], settings[i][0], settings[i][1]);
}

static void (*const calls[])(struct machine *, unsigned slot, unsigned argument) = {
    load_library,  take_builtin, share_library, drop_library, load_document,
    drop_document, make_options, set_option,    generate,     validate,
    inspect,       read_result,  read_document, read_library, begin_edit,
    change_edit,   end_edit,     read_elements, pack_values,  set_names};
enum { NUM_CALLS = sizeof calls / sizeof *calls, MAX_CALLS = 64 };

void fuzz_run(const char *data, size_t size, struct fuzz_heap *heap)
{
    struct machine m = {0};
    struct fuzz_files files;
    fuzz_files_split(&files, parts, sizeof parts - 1);
    static const char *const defaults[] = {"prefix", "my_"};
    static const mxg_dialect dialect = {sizeof dialect, "nothing", "glsl",      "330",
                                        defaults,       1,         {NULL, NULL}};
    static const mxg_dialect *const dialects[] = {&dialect};
    m.context = fuzz_files_context(&files, heap,
                                   (mxg_context_desc){.max_memory = (size_t)64 << 20,
                                                      .dialects = dialects,
                                                      .num_dialects = 1});
    for (size_t i = 0; i + 1 < size && i < 2 * MAX_CALLS; i += 2) {
        unsigned call = (unsigned char)data[i], argument = (unsigned char)data[i + 1];
        calls[call % NUM_CALLS](&m, call / NUM_CALLS % NUM_SLOTS, argument);
    }
    for (int i = 0; i < NUM_SLOTS; i++) {
        mxg_library_unref(m.libraries[i]);
        mxg_document_destroy(m.documents[i]);
        mxg_edit_destroy(m.edits[i]);
        mxg_options_destroy(m.options[i]);
        mxg_result_destroy(m.results[i]);
    }
    mxg_context_destroy(m.context);
    FUZZ_REQUIRE(files.num_open == 0);
}
