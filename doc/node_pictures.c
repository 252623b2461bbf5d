// SPDX-License-Identifier: Apache-2.0
/*
 * Pictures of nodes: a document for each, which mxgen-render draws on its ball. The reference
 * pictures patterns that vary over a surface, and closures and shaders that need no others.
 */
#define _POSIX_C_SOURCE 200809L
#include "doc/manual.h"
#include "program/file_name.h"
#include "program/files.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

#define PICTURE_SIZE "288" /* the page shows it at half the size */

/* ---- Nodes with a picture ---- */

static const struct shown_type {
    const char *name;
    const char *input; /* input of <surface> for closures */
    bool is_pattern;
} shown_types[] = {
    /* a node shows its first output whose type is in this order */
    {"float", NULL, true},     {"color3", NULL, true},  {"color4", NULL, true},
    {"vector2", NULL, true},   {"vector3", NULL, true}, {"vector4", NULL, true},
    {"BSDF", "bsdf", false},   {"EDF", "edf", false},   {"surfaceshader", NULL, false},
    {"material", NULL, false},
};
enum { NUM_SHOWN_TYPES = sizeof shown_types / sizeof *shown_types };

struct shown {
    const struct manual_node *node;
    const struct manual_variant *variant;
    const struct shown_type *type;
    const char *output;
    bool on_plane; /* it varies with the texture coordinates: a plane shows it without distortion */
};

static bool is_any_of(const char *text, const char *const *list)
{
    for (; *list; ++list)
        if (strcmp(text, *list) == 0)
            return true;
    return false;
}

static const struct example {
    const char *node, *input; /* no input: the node has no picture */
    const char *value;
    int scale; /* scale of the coordinates; 0: use the value */
} examples[] = {
#define VALUE(node, input, value) {#node, #input, value, 0},
#define SCALE(node, input, factor) {#node, #input, NULL, factor},
#define NONE(node) {#node, NULL, NULL, 0},
#include "doc/examples.def"
#undef VALUE
#undef SCALE
#undef NONE
};
enum { NUM_EXAMPLES = sizeof examples / sizeof *examples };

static bool is_example_of(const struct example *example, const struct manual_node *node)
{
    return strcmp(example->node, node->name) == 0;
}

static bool is_excluded(const struct manual_node *node)
{
    for (size_t i = 0; i < NUM_EXAMPLES; ++i)
        if (is_example_of(&examples[i], node) && !examples[i].input)
            return true;
    return false;
}

static bool is_texture(const mxg_port *port)
{
    return strcmp(port->type, "filename") == 0;
}

/*
 * True if the inputs can stay unconnected, and for patterns if one input varies. Only the plane has
 * a texture.
 */
static bool is_worth_showing(const struct manual *manual, struct shown *shown)
{
    static const char *const dependent[] = {"BSDF",          "EDF",          "VDF",
                                            "surfaceshader", "volumeshader", NULL};
    bool varies = !shown->type->is_pattern || strcmp(shown->node->group, "geometric") == 0,
         textured = false;
    shown->on_plane = strcmp(shown->type->name, "vector2") == 0;
    for (uint32_t i = 0; i < shown->variant->def.num_inputs; ++i) {
        mxg_port port = {sizeof port};
        mxg_library_port(manual->library, shown->variant->index, i, &port);
        if (is_any_of(port.type, dependent))
            return false;
        varies = varies || *port.defaultgeomprop;
        textured = textured || is_texture(&port);
        shown->on_plane = shown->on_plane || strcmp(port.defaultgeomprop, "UV0") == 0;
    }
    return varies && (shown->on_plane || !textured) && !is_excluded(shown->node);
}

/* The first output of this type; false: none. */
static bool choose_output(const struct manual *manual, const struct manual_variant *variant,
                          const char *type, struct shown *shown)
{
    for (uint32_t i = 0; i < variant->def.num_outputs; ++i) {
        mxg_port port = {sizeof port};
        mxg_library_port(manual->library, variant->index, variant->def.num_inputs + i, &port);
        shown->output = port.name;
        if (strcmp(port.type, type) == 0)
            return true;
    }
    return false;
}

/* Chooses the variant whose type comes first in the table; a texture shows colours. */
static bool choose(const struct manual *manual, const struct manual_node *node, struct shown *shown)
{
    const struct manual_edition *edition = &node->editions[0];
    for (size_t t = strncmp(node->group, "texture", 7) == 0; t < NUM_SHOWN_TYPES; ++t) {
        for (size_t i = 0; i < edition->num_variants; ++i) {
            *shown = (struct shown){
                .node = node, .variant = &edition->variants[i], .type = &shown_types[t]};
            if (choose_output(manual, shown->variant, shown->type->name, shown))
                return is_worth_showing(manual, shown);
        }
    }
    return false;
}

/* ---- Its document ---- */

/* The example value of an input; NULL: use its default. */
static const struct example *find_example(const struct shown *shown, const mxg_port *port)
{
    static const struct example texture = {NULL, NULL, "texture.png", 0};
    for (size_t i = 0; i < NUM_EXAMPLES; ++i)
        if (is_example_of(&examples[i], shown->node) && strcmp(examples[i].input, port->name) == 0)
            return &examples[i];
    return is_texture(port) ? &texture : NULL;
}

/* Scaled coordinates come from extra nodes before the node in the picture. */
static void put_coordinates(FILE *out, const mxg_port *port, int scale)
{
    const char *source = strcmp(port->type, "vector2") == 0 ? "texcoord" : "position";
    fprintf(out,
            "    <%s name=\"coordinates\" type=\"%s\"/>\n"
            "    <multiply name=\"scaled\" type=\"%s\">\n"
            "      <input name=\"in1\" type=\"%s\" nodename=\"coordinates\"/>\n"
            "      <input name=\"in2\" type=\"float\" value=\"%d\"/>\n"
            "    </multiply>\n",
            source, port->type, port->type, port->type, scale);
}

/* Writes the inputs with example values; with `before` the nodes that they come from. */
static void put_inputs(const struct manual *manual, FILE *out, const struct shown *shown,
                       bool before)
{
    for (uint32_t i = 0; i < shown->variant->def.num_inputs; ++i) {
        mxg_port port = {sizeof port};
        mxg_library_port(manual->library, shown->variant->index, i, &port);
        const struct example *example = find_example(shown, &port);
        if (!example)
            continue;
        if (before && example->scale)
            put_coordinates(out, &port, example->scale);
        else if (!before)
            fprintf(out, "      <input name=\"%s\" type=\"%s\" %s=\"%s\"/>\n", port.name, port.type,
                    example->scale ? "nodename" : "value",
                    example->scale ? "scaled" : example->value);
    }
}

static void put_shown(const struct manual *manual, FILE *out, const struct shown *shown)
{
    put_inputs(manual, out, shown, true);
    fprintf(out, "    <%s name=\"shown\" type=\"%s\" nodedef=\"%s\">\n", shown->node->name,
            shown->variant->def.num_outputs > 1 ? "multioutput" : shown->type->name,
            shown->variant->def.name);
    put_inputs(manual, out, shown, false);
    fprintf(out, "    </%s>\n", shown->node->name);
}

/* A pattern is an output of a graph; for vectors, -1 is black and 1 is white. */
static void put_pattern(const struct manual *manual, FILE *out, const struct shown *shown)
{
    bool is_vector = strcmp(shown->type->name, "vector3") == 0;
    fputs("  <nodegraph name=\"graph\">\n", out);
    put_shown(manual, out, shown);
    char *output = shown->variant->def.num_outputs > 1 ? cli_format(" output=\"%s\"", shown->output)
                                                       : cli_format("%s", "");
    if (is_vector)
        fprintf(out,
                "    <range name=\"visible\" type=\"vector3\">\n"
                "      <input name=\"in\" type=\"vector3\" nodename=\"shown\"%s/>\n"
                "      <input name=\"inlow\" type=\"vector3\" value=\"-1, -1, -1\"/>\n"
                "    </range>\n",
                output);
    fprintf(out, "    <output name=\"out\" type=\"%s\" nodename=\"%s\"%s/>\n  </nodegraph>\n",
            shown->type->name, is_vector ? "visible" : "shown", is_vector ? "" : output);
    free(output);
}

/* A closure needs a surface, and a surface a material. */
static void put_material(const struct manual *manual, FILE *out, const struct shown *shown)
{
    const char *input = shown->type->input;
    put_shown(manual, out, shown);
    if (input)
        fprintf(out,
                "    <surface name=\"surface\" type=\"surfaceshader\">\n"
                "      <input name=\"%s\" type=\"%s\" nodename=\"shown\"/>\n"
                "    </surface>\n",
                input, shown->type->name);
    if (strcmp(shown->type->name, "material") != 0)
        fprintf(out,
                "    <surfacematerial name=\"material\" type=\"material\">\n"
                "      <input name=\"surfaceshader\" type=\"surfaceshader\" nodename=\"%s\"/>\n"
                "    </surfacematerial>\n",
                input ? "surface" : "shown");
}

static bool write_document(const struct manual *manual, struct cli *cli, const struct shown *shown,
                           const char *path)
{
    char *data = NULL;
    size_t size = 0;
    FILE *out = open_memstream(&data, &size);
    if (!out)
        return report_status(&cli->report, MXG_ERROR_MEMORY);
    fputs("<?xml version=\"1.0\"?>\n<materialx version=\"1.39\">\n", out);
    (shown->type->is_pattern ? put_pattern : put_material)(manual, out, shown);
    fputs("</materialx>\n", out);
    const char *reason = fclose(out) == 0 ? files_write(path, data, size) : strerror(errno);
    if (reason)
        report_error(&cli->report, "output-failed", "cannot write '%s': %s", path, reason);
    free(data);
    return !reason;
}

/* ---- Drawing it ---- */

/* The renderer's arguments, with the libraries of this run. The caller frees them. */
static char **renderer_arguments(const struct cli *cli, char *program)
{
    const struct arg_list *inputs = &cli->parser.inputs;
    char **argv = calloc(2 * inputs->len + 12, sizeof *argv);
    if (!argv)
        return NULL;
    size_t n = 0;
    const char *const fixed[] = {program,   NULL, "-q", "--size", PICTURE_SIZE,
                                 "--scene", NULL, "-o", NULL};
    for (; n < sizeof fixed / sizeof *fixed; ++n)
        argv[n] = (char *)(uintptr_t)fixed[n];
    if (cli->no_builtin_library)
        argv[n++] = (char *)(uintptr_t) "--no-builtin-library";
    for (size_t i = 1; i < inputs->len; ++i) {
        argv[n++] = (char *)(uintptr_t) "--library";
        argv[n++] = (char *)(uintptr_t)inputs->items[i];
    }
    return argv;
}
enum { ARGUMENT_DOCUMENT = 1, ARGUMENT_SCENE = 6, ARGUMENT_PICTURE = 8 };

static bool draw_node(struct manual *manual, struct cli *cli, struct manual_node *node,
                      const char *folder, char **argv)
{
    struct shown shown;
    if (!choose(manual, node, &shown))
        return true;
    const char *name = manual_keep(manual, file_name_of_element(node->id));
    const char *picture = manual_keep(manual, cli_format("pictures/%s.png", name));
    argv[ARGUMENT_DOCUMENT] =
        (char *)(uintptr_t)manual_keep(manual, cli_format("%s/pictures/%s.mtlx", folder, name));
    argv[ARGUMENT_PICTURE] =
        (char *)(uintptr_t)manual_keep(manual, cli_format("%s/%s", folder, picture));
    argv[ARGUMENT_SCENE] = (char *)(uintptr_t)(shown.on_plane ? "plane" : "sphere");
    int status = 0;
    if (!write_document(manual, cli, &shown, argv[ARGUMENT_DOCUMENT])
        || !cli_run(&cli->report, argv, &status))
        return false;
    if (status == 0)
        node->picture = picture;
    else
        report_error(&cli->report, "no-picture", "the renderer made no picture of '%s'",
                     node->name);
    return status == 0;
}

bool manual_draw(struct manual *manual, struct cli *cli, const char *folder)
{
    char *pictures = cli_format("%s/pictures", folder);
    char *program = cli_program("mxgen-render");
    char **argv = renderer_arguments(cli, program);
    const char *reason = files_make_folder(pictures);
    if (reason)
        report_error(&cli->report, "output-failed", "cannot make the folder '%s': %s", pictures,
                     reason);
    bool good = argv && !reason, any = false;
    /* If the first picture fails there is no device, so all would fail. */
    for (size_t i = 0; (good || any) && i < manual->num_nodes; ++i) {
        good = draw_node(manual, cli, &manual->nodes[i], folder, argv) && good;
        any = any || manual->nodes[i].picture;
    }
    free(argv);
    free(program);
    free(pictures);
    return good;
}
