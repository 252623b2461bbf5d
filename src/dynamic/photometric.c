// SPDX-License-Identifier: Apache-2.0
/*
 * measured_edf: emission by a photometric file (ANSI/IES LM-63, type C). The shader gets a table of
 * intensities by the angle from the normal, relative to the maximum. The table averages around the
 * normal, because the node has no direction for the horizontal angle.
 */
#include "build/build_priv.h"

#include "base/num.h"
#include "shader/formula.h"

#include <math.h>

/* degrees between entries, and number of entries */
enum { STEP = 2, LENGTH = 180 / STEP + 1, MAX_ANGLES = 4096 };

struct measurement {
    const char *at, *end;
    const char *fault; /* NULL: no fault */
    unsigned num_vertical, num_horizontal;
    /* candela: all vertical angles of the first horizontal one, then of the next … */
    float *vertical, *horizontal, *candela;
};

/* ---- Reading ---- */

/*
 * Skips to the end of the line that begins with "TILT="; out_include: the tilt table of the lamp
 * follows.
 */
static void skip_keywords(struct measurement *m, bool *out_include)
{
    while (m->at < m->end) {
        const char *line = m->at, *newline = memchr(line, '\n', (size_t)(m->end - line));
        m->at = newline ? newline + 1 : m->end;
        if ((size_t)(m->at - line) < 5 || memcmp(line, "TILT=", 5) != 0)
            continue;
        *out_include = (size_t)(m->at - line) >= 12 && memcmp(line + 5, "INCLUDE", 7) == 0;
        return;
    }
    m->fault = "it has no line TILT=";
}

static float next_number(struct measurement *m)
{
    float value = 0.0f;
    while (m->at < m->end && strchr(" \t\r\n,", *m->at))
        m->at++;
    size_t len = num_parse_float(m->at, (size_t)(m->end - m->at), &value);
    if (!len && !m->fault)
        m->fault = "a number is missing";
    if (!isfinite(value) && !m->fault)
        m->fault = "one of its numbers is infinite, because the numbers of a float end at 3.4e38";
    m->at += len;
    return value;
}

static float *next_numbers(struct measurement *m, struct arena *arena, size_t count)
{
    float *numbers = ARENA_ARRAY(arena, float, count);
    for (size_t i = 0; i < count && !m->fault; i++)
        numbers[i] = next_number(m);
    return numbers;
}

static unsigned next_count(struct measurement *m)
{
    float count = next_number(m);
    if (!m->fault && !(count >= 1.0f && count <= MAX_ANGLES))
        m->fault = "its number of angles is invalid";
    return m->fault ? 0 : (unsigned)count;
}

static bool ascends(const float *numbers, unsigned count)
{
    for (unsigned i = 1; i < count; i++)
        if (!(numbers[i] > numbers[i - 1]))
            return false;
    return true;
}

static void read_measurement(struct measurement *m, struct arena *arena)
{
    /* lamps, lumens, factor; units, three sizes, two ballast values, watts */
    enum { BEFORE_ANGLES = 3, BEHIND_TYPE = 7 };
    bool has_tilt = false;
    skip_keywords(m, &has_tilt);
    if (has_tilt) {
        next_number(m);
        unsigned count = next_count(m);
        next_numbers(m, arena, 2 * (size_t)count);
    }
    next_numbers(m, arena, BEFORE_ANGLES);
    m->num_vertical = next_count(m);
    m->num_horizontal = next_count(m);
    if (next_number(m) != 1.0f && !m->fault)
        m->fault = "it is not of photometric type C";
    next_numbers(m, arena, BEHIND_TYPE);
    assert(m->fault || (m->num_vertical <= MAX_ANGLES && m->num_horizontal <= MAX_ANGLES));
    m->vertical = next_numbers(m, arena, m->num_vertical);
    m->horizontal = next_numbers(m, arena, m->num_horizontal);
    m->candela =
        m->fault ? NULL : next_numbers(m, arena, (size_t)m->num_vertical * m->num_horizontal);
    if (!m->fault
        && (!ascends(m->vertical, m->num_vertical) || !ascends(m->horizontal, m->num_horizontal)))
        m->fault = "its angles do not ascend";
}

/* ---- The table ---- */

/* The part of the circle for a horizontal angle: half the way to each neighbour. */
static float share(const struct measurement *m, unsigned i)
{
    assert(i < m->num_horizontal);
    if (m->num_horizontal == 1)
        return 1.0f;
    float before = m->horizontal[i > 0 ? i - 1 : i],
          behind = m->horizontal[i + 1 < m->num_horizontal ? i + 1 : i];
    return 0.5f * (behind - before) / (m->horizontal[m->num_horizontal - 1] - m->horizontal[0]);
}

/* The mean around the axis, at a measured vertical angle. */
static float mean(const struct measurement *m, unsigned vertical)
{
    assert(vertical < m->num_vertical);
    float sum = 0.0f;
    for (unsigned i = 0; i < m->num_horizontal; i++)
        sum += share(m, i) * m->candela[(size_t)i * m->num_vertical + vertical];
    return sum;
}

/* Linear between the measured angles; 0 outside them. */
static float intensity(const struct measurement *m, float angle)
{
    unsigned i = 0;
    if (angle < m->vertical[0] || angle > m->vertical[m->num_vertical - 1])
        return 0.0f;
    while (i + 1 < m->num_vertical && m->vertical[i + 1] < angle)
        i++;
    if (i + 1 == m->num_vertical)
        return mean(m, i);
    float t = (angle - m->vertical[i]) / (m->vertical[i + 1] - m->vertical[i]);
    return mean(m, i) * (1.0f - t) + mean(m, i + 1) * t;
}

static void make_table(struct measurement *m, float table[LENGTH])
{
    float greatest = 0.0f;
    for (int i = 0; i < LENGTH; i++) {
        table[i] = intensity(m, (float)(i * STEP));
        greatest = table[i] > greatest ? table[i] : greatest;
    }
    for (int i = 0; i < LENGTH && greatest > 0.0f; i++)
        table[i] /= greatest;
    if (!(greatest > 0.0f))
        m->fault = "all its values are 0";
}

static bool read_table(struct builder *b, elem_id element, const char *file, float table[LENGTH])
{
    const struct lang_reader *reader = b->options->reader;
    struct diag_place place = doc_attr_place(&b->lib->doc, element, STR_value);
    const char *name, *text, *reason = "there is no reader";
    size_t len;
    if (!reader
        || !reader->read(reader->user_data, place.file ? place.file : "", file, &name, &text, &len,
                         &reason)) {
        diag_add(b->diags, DIAG_ID_no_profile, place, file, reason);
        return false;
    }
    struct measurement m = {.at = text, .end = text + len};
    read_measurement(&m, b->arena);
    if (!m.fault)
        make_table(&m, table);
    if (m.fault)
        diag_add(b->diags, DIAG_ID_no_profile, place, file, m.fault);
    return !m.fault;
}

/* ---- In the shader ---- */

/* The number of entries up to the last nonzero one, and one more. */
static unsigned used_length(const float table[LENGTH])
{
    unsigned length = LENGTH;
    while (length > 2 && table[length - 2] == 0.0f && table[length - 1] == 0.0f)
        length--;
    return length;
}

/* From the viewer to the surface; poison after a report. */
static ir_ref view_direction(struct builder *b)
{
    static const char name[] = "Vworld";
    const struct geomprop *view = library_geomprop(b->lib, str_intern_z(b->shader->strings, name));
    if (!view)
        diag_add(b->diags, DIAG_ID_unknown_geomprop, (struct diag_place){0}, name, "");
    return view ? build_geomprop(b, view) : ir_poison(b->graph, IR_TYPE_VEC3);
}

/* The table's value at the angle between the normal and the viewer. */
static ir_ref look_up(struct builder *b, const float table[LENGTH], ir_ref normal)
{
    struct ir_graph *g = b->graph;
    ir_ref entries[LENGTH];
    unsigned length = used_length(table);
    assert(length >= 2 && length <= LENGTH);
    for (unsigned i = 0; i < length; i++)
        entries[i] = ir_const_float(g, table[i]);
    ir_ref array =
        ir_construct(g, (ir_type_id)ir_add_array(g, IR_TYPE_FLOAT, length), entries, length);
    ir_ref per_degree = ir_const_float(g, 1.0f / STEP),
           last = ir_const_float(g, (float)(length - 1));
    ir_ref at = FORMULA(b->shader, "mx_profile_place", normal, view_direction(b), per_degree, last);
    ir_ref whole = ir_op1(g, IR_FLOOR, at),
           below = ir_op2(g, IR_MIN, whole, ir_const_float(g, (float)(length - 2)));
    ir_ref index = ir_convert(g, IR_TYPE_INT, below);
    ir_ref values[2];
    for (int i = 0; i < 2; i++)
        values[i] = ir_build(g, IR_INDEX, IR_TYPE_FLOAT, 0,
                             (ir_ref[]){array, ir_op2(g, IR_ADD, index, ir_const_int(g, i))}, 2);
    return ir_op3(g, IR_MIX, values[0], values[1], ir_op2(g, IR_SUB, at, below));
}

/*
 * The library's even emission, scaled by the profile in the file of the texture `file`. Without
 * this library node the result is 0.
 */
ir_ref build_measured_edf(struct builder *b, ir_ref color, ir_ref normal, ir_ref file, elem_id node)
{
    str_id even = str_find(b->shader->strings, "ND_uniform_edf", strlen("ND_uniform_edf"));
    uint32_t nodedef = even ? library_nodedef_by_name(b->lib, even) : LIBRARY_NONE;
    const struct ir_node *source = file ? ir_get(b->graph, file) : NULL;
    const struct shader_variable *texture =
        source && source->op == IR_TEXTURE ? &b->shader->interface.variables.items[source->attr]
                                           : NULL;
    float table[LENGTH];
    if (texture && *build_text(b, texture->file)) {
        struct shader_compiled_input compiled = {texture->element, texture->definition,
                                                 texture->doc_type};
        vec_push(b->arena, &b->shader->reflection.compiled, compiled);
        if (read_table(b, texture->element, build_text(b, texture->file), table))
            color = ir_op2(b->graph, IR_MUL, color, look_up(b, table, normal));
    }
    ir_ref results[LIBRARY_MAX_OUTPUTS] = {0};
    if (nodedef != LIBRARY_NONE)
        build_apply(b, nodedef, node, &color, results);
    return results[0];
}
