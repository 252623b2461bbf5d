// SPDX-License-Identifier: Apache-2.0
/*
 * Every definition of the built-in library has the interface that MaterialX 1.39 (interfaces.tsv)
 * or ShaderX 2018 (shaderx.tsv; its surface, volume, displacement and blackbody are MaterialX's,
 * and what it leaves open is as in the node it stands on) gives it, is of OSL generators (osl.tsv),
 * or is listed as ours (colorspaces.tsv, own.tsv). A row per definition:
 *
 *     name  node  library  version  isdefault  group  inherit  inputs  outputs
 *
 * Ports are separated by " | ". An input is "name:type[@geomprop][=value][ [uniform]][ {enum}][
 * unit:type/unit][ range:min..max]", an output "name:type[=value][ default value][ ->input]", of
 * which the interface tells the default. A range that is not given may be any.
 *
 *     test_interfaces TABLE...
 */
#include <mxgen/mxgen.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    NAME,
    NODE,
    LIBRARY,
    VERSION,
    IS_DEFAULT,
    GROUP,
    INHERIT,
    INPUTS,
    OUTPUTS,
    NUM_COLUMNS,
    MAX_ROWS = 1024,
    MAX_LINE = 1 << 16
};

struct row {
    char *columns[NUM_COLUMNS];
};

static struct row rows[MAX_ROWS];
static unsigned num_rows;

static char *copy(const char *text, size_t len)
{
    char *result = calloc(1, len + 1);
    if (!result)
        exit(1);
    return memcpy(result, text, len);
}

static bool read_rows(const char *path)
{
    static char line[MAX_LINE];
    FILE *file = fopen(path, "r");
    if (!file || !fgets(line, sizeof line, file)) /* the names of the columns */
        return false;
    for (; num_rows < MAX_ROWS && fgets(line, sizeof line, file); ++num_rows) {
        const char *at = line;
        for (int i = 0; i < NUM_COLUMNS; ++i) {
            size_t len = strcspn(at, "\t\n");
            rows[num_rows].columns[i] = copy(at, len);
            at += len + (at[len] == '\t');
        }
    }
    fclose(file);
    return true;
}

static const struct row *find_row(const char *name)
{
    for (unsigned i = 0; i < num_rows; ++i)
        if (strcmp(rows[i].columns[NAME], name) == 0)
            return &rows[i];
    return NULL;
}

/* ---- Ports ---- */

struct port {
    char name[64], type[64], geomprop[64], value[512], enums[512], unit[64], min[32], max[32];
    bool uniform;
};

static void set(char *out, size_t room, const char *text, size_t len)
{
    snprintf(out, room, "%.*s", (int)len, text);
}

/* Text between `open` and `close`, which is cut off; "" where it is not at the end. */
static void cut(char *text, const char *open, const char *close, char *out, size_t room)
{
    char *at = strstr(text, open);
    out[0] = '\0';
    if (!at)
        return;
    const char *from = at + strlen(open);
    const char *end = *close ? strstr(from, close) : from + strcspn(from, " ");
    set(out, room, from, end ? (size_t)(end - from) : strlen(from));
    memset(at, ' ', end ? (size_t)(end - at) + strlen(close) : strlen(at));
}

static void parse_port(const char *text, size_t len, bool is_output, struct port *out)
{
    char rest[1024], uniform[2];
    *out = (struct port){.uniform = false};
    set(rest, sizeof rest, text, len);
    out->uniform = strstr(rest, " [uniform]") != NULL;
    cut(rest, " [uniform", "]", uniform, sizeof uniform);
    cut(rest, " {", "}", out->enums, sizeof out->enums);
    char unit[128], range[64], passed_input[64], output_default[128];
    cut(rest, " ->", "", passed_input, sizeof passed_input);
    cut(rest, " default ", "\n", output_default, sizeof output_default); /* to the end */
    cut(rest, " unit:", "", unit, sizeof unit);
    cut(rest, " range:", "", range, sizeof range);
    const char *dots = strstr(range, "..");
    if (dots) {
        set(out->min, sizeof out->min, range, (size_t)(dots - range));
        set(out->max, sizeof out->max, dots + 2, strlen(dots + 2));
    }
    const char *slash = strchr(unit, '/');
    set(out->unit, sizeof out->unit, slash ? slash + 1 : "", strlen(slash ? slash + 1 : ""));
    size_t end = strlen(rest);
    while (end && rest[end - 1] == ' ')
        rest[--end] = '\0';
    char *value = strchr(rest, '=');
    if (value) {
        set(out->value, sizeof out->value, value + 1, strlen(value + 1));
        *value = '\0';
    }
    if (is_output)
        set(out->value, sizeof out->value, output_default, strlen(output_default));
    char *type = strchr(rest, ':'), *geomprop = strchr(rest, '@');
    if (geomprop) {
        set(out->geomprop, sizeof out->geomprop, geomprop + 1, strlen(geomprop + 1));
        *geomprop = '\0';
    }
    if (!type)
        return;
    set(out->name, sizeof out->name, rest, (size_t)(type - rest));
    set(out->type, sizeof out->type, type + 1, strlen(type + 1));
}

/* The ports of a column and those inherited, which stand behind the own. Returns their number. */
static unsigned list_ports(const struct row *row, int column, struct port *out, unsigned room)
{
    unsigned count = 0;
    for (; row; row = *row->columns[INHERIT] ? find_row(row->columns[INHERIT]) : NULL) {
        for (const char *at = row->columns[column]; *at && count < room;) {
            const char *end = strstr(at, " | ");
            size_t len = end ? (size_t)(end - at) : strlen(at);
            parse_port(at, len, column == OUTPUTS, &out[count]);
            bool known = false;
            for (unsigned i = 0; i < count; ++i)
                known = known || strcmp(out[i].name, out[count].name) == 0;
            count += !known;
            at += len + (end ? 3 : 0);
        }
    }
    return count;
}

/* ---- Comparison ---- */

/* Lists of numbers by value, others as words; spaces around commas mean nothing. */
static bool same_value(const char *a, const char *b)
{
    for (;;) {
        a += strspn(a, " ");
        b += strspn(b, " ");
        size_t n = strcspn(a, ","), m = strcspn(b, ",");
        while (n && a[n - 1] == ' ')
            --n;
        while (m && b[m - 1] == ' ')
            --m;
        char *end_a, *end_b;
        double x = strtod(a, &end_a), y = strtod(b, &end_b);
        bool numbers = n && m && end_a == a + n && end_b == b + m;
        if (numbers ? (float)x != (float)y : n != m || memcmp(a, b, n) != 0)
            return false;
        a += strcspn(a, ",");
        b += strcspn(b, ",");
        if (!*a || !*b)
            return !*a && !*b;
        ++a, ++b;
    }
}

static unsigned faults;

static void expect(bool good, const char *nodedef, const char *port, const char *what,
                   const char *is, const char *should)
{
    faults += !good;
    if (!good)
        printf("%s: %s: %s is '%s', should be '%s'\n", nodedef, port, what, is, should);
}

static void compare_port(const char *nodedef, const mxg_port *is, const struct port *should)
{
    expect(strcmp(is->name, should->name) == 0, nodedef, should->name, "name", is->name,
           should->name);
    expect(strcmp(is->type, should->type) == 0, nodedef, should->name, "type", is->type,
           should->type);
    expect(same_value(is->value, should->value), nodedef, should->name, "default", is->value,
           should->value);
    expect(strcmp(is->defaultgeomprop, should->geomprop) == 0, nodedef, should->name,
           "defaultgeomprop", is->defaultgeomprop, should->geomprop);
    expect(is->uniform == should->uniform, nodedef, should->name, "uniform",
           is->uniform ? "true" : "false", should->uniform ? "true" : "false");
    expect(same_value(is->enum_names, should->enums), nodedef, should->name, "enum", is->enum_names,
           should->enums);
    expect(strcmp(is->unit, should->unit) == 0, nodedef, should->name, "unit", is->unit,
           should->unit);
    if (*should->min) {
        expect(same_value(is->uimin, should->min), nodedef, should->name, "uimin", is->uimin,
               should->min);
        expect(same_value(is->uimax, should->max), nodedef, should->name, "uimax", is->uimax,
               should->max);
    }
}

static void compare_nodedef(const mxg_library *library, uint32_t index, const mxg_nodedef *def,
                            const struct row *row)
{
    static struct port ports[512];
    char number[2][16];
    expect(strcmp(def->node, row->columns[NODE]) == 0, def->name, "", "node", def->node,
           row->columns[NODE]);
    expect(strcmp(def->version, row->columns[VERSION]) == 0, def->name, "", "version", def->version,
           row->columns[VERSION]);
    expect(strcmp(def->group, row->columns[GROUP]) == 0, def->name, "", "nodegroup", def->group,
           row->columns[GROUP]);
    expect(def->has_implementation, def->name, "", "implementation", "missing", "there");
    for (int column = INPUTS; column <= OUTPUTS; ++column) {
        uint32_t count = column == INPUTS ? def->num_inputs : def->num_outputs,
                 should = list_ports(row, column, ports, 512);
        snprintf(number[0], sizeof *number, "%u", count);
        snprintf(number[1], sizeof *number, "%u", should);
        expect(count == should, def->name, column == INPUTS ? "inputs" : "outputs", "number",
               number[0], number[1]);
        for (uint32_t i = 0; i < count && i < should; ++i) {
            mxg_port port = {sizeof port};
            mxg_library_port(library, index, (column == OUTPUTS ? def->num_inputs : 0) + i, &port);
            compare_port(def->name, &port, &ports[i]);
        }
    }
}

/* True if the surface "A" of a translation "A_to_B" documents the input. */
static bool is_in_surface(const mxg_library *library, const mxg_nodedef *translation,
                          const char *input)
{
    const char *end = strstr(translation->node, "_to_");
    size_t len = end ? (size_t)(end - translation->node) : 0;
    for (uint32_t i = 0; i < mxg_library_num_nodedefs(library); ++i) {
        mxg_nodedef def = {sizeof def};
        mxg_library_nodedef(library, i, &def);
        if (strlen(def.node) != len || strncmp(def.node, translation->node, len) != 0)
            continue;
        for (uint32_t k = 0; k < def.num_inputs; ++k) {
            mxg_port port = {sizeof port};
            mxg_library_port(library, i, k, &port);
            if (strcmp(port.name, input) == 0 && *port.doc)
                return true;
        }
    }
    return false;
}

/*
 * Everything that `mxgen library doc` tells has a meaning. Inputs of translations are those of
 * surfaces, which have their docs.
 */
static void require_documentation(const mxg_library *library, uint32_t index,
                                  const mxg_nodedef *def)
{
    expect(*def->doc, def->name, "", "doc", "", "a sentence");
    for (uint32_t i = 0; i < def->num_inputs; ++i) {
        mxg_port port = {sizeof port};
        mxg_library_port(library, index, i, &port);
        bool has_doc =
            *port.doc
            || (strcmp(def->group, "translation") == 0 && is_in_surface(library, def, port.name));
        expect(has_doc, def->name, port.name, "doc", "", "a sentence");
    }
}

/*
 * It is part of every program that embeds mxgen, and of its memory. Translations are the part that
 * grows: a pair of models that one step between them cannot keep has a node of its own, of 7 KB.
 * The formulas that the compiler calls are in it, too: what was arithmetic in C counts here.
 */
static bool is_small(mxg_library *library)
{
    enum { BUDGET = 2000 * 1000 };
    const void *image;
    size_t size = 0;
    mxg_library_image(library, &image, &size);
    printf("library image: %zu bytes of %d\n", size, BUDGET);
    return size > 0 && size <= BUDGET;
}

int main(int argc, char **argv)
{
    unsigned passed = 0, failed = 0;
    mxg_context *context = NULL;
    for (int i = 1; i < argc; ++i)
        if (!read_rows(argv[i])) {
            printf("cannot read '%s'\n", argv[i]);
            return 1;
        }
    if (mxg_context_create(NULL, &context) != MXG_OK)
        return 1;
    mxg_library *library = mxg_library_builtin(context);
    for (uint32_t i = 0; i < mxg_library_num_nodedefs(library); ++i) {
        mxg_nodedef def = {sizeof def};
        mxg_library_nodedef(library, i, &def);
        const struct row *row = find_row(def.name);
        faults = 0;
        if (row)
            compare_nodedef(library, i, &def, row);
        else
            expect(false, def.name, "", "definition", "there", "in no table");
        require_documentation(library, i, &def);
        ++*(faults ? &failed : &passed);
    }
    failed += passed + failed != num_rows;
    ++*(is_small(library) ? &passed : &failed);
    if (mxg_library_num_nodedefs(library) != num_rows)
        printf("the library has %u definitions, the tables %u\n", mxg_library_num_nodedefs(library),
               num_rows);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    for (unsigned i = 0; i < num_rows; ++i)
        for (int column = 0; column < NUM_COLUMNS; ++column)
            free(rows[i].columns[column]);
    printf("interfaces: %u passed, %u failed, 0 skipped\n", passed, failed);
    return failed ? 1 : 0;
}
