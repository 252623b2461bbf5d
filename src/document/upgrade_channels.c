// SPDX-License-Identifier: Apache-2.0
/*
 * Channel selection. Before 1.39 a port had channels="bgr", and <swizzle> had a string of channels:
 * letters of either family (rgba, xyzw) and the constants 0 and 1. Both become <extract>,
 * <convert>, <combine> after <separate>, or a constant.
 */
#include "document/upgrade.h"

#include <assert.h>

enum { MAX_CHANNELS = 4 };

/* 0 to 3: a channel; CHANNEL_ZERO, CHANNEL_ONE: a constant; CHANNEL_BAD: invalid. */
enum { CHANNEL_ZERO = 4, CHANNEL_ONE, CHANNEL_BAD };

struct selection {
    str_id from, to; /* types */
    unsigned num_from, num_to;
    unsigned channels[MAX_CHANNELS];
};

static unsigned channel_of(char c)
{
    static const char letters[] = "rgbaxyzw01";
    static const uint8_t channels[] = {0, 1, 2, 3, 0, 1, 2, 3, CHANNEL_ZERO, CHANNEL_ONE};
    const char *found = c ? strchr(letters, c) : NULL;
    return found ? channels[found - letters] : CHANNEL_BAD;
}

static unsigned channel_count(str_id type)
{
    switch (type) {
    case STR_float:
    case STR_color3:
    case STR_color4:
    case STR_vector2:
    case STR_vector3:
    case STR_vector4: return doc_type_components(doc_type_of(type));
    default: return 0;
    }
}

/*
 * A missing or unknown channel means the first one, with a warning. false: the types have no
 * channels.
 */
static bool read_selection(const struct upgrade *u, str_id from, str_id to, str_id channels,
                           struct diag_place place, struct selection *out)
{
    const char *text = str_text(u->doc->strings, channels);
    size_t len = str_len(u->doc->strings, channels);
    *out = (struct selection){
        .from = from, .to = to, .num_from = channel_count(from), .num_to = channel_count(to)};
    assert(out->num_from <= MAX_CHANNELS && out->num_to <= MAX_CHANNELS);
    bool is_complete = true;
    for (unsigned i = 0; i < out->num_to; i++) {
        unsigned channel = i < len ? channel_of(text[i]) : CHANNEL_BAD;
        bool missing =
            channel == CHANNEL_BAD || (channel < CHANNEL_ZERO && channel >= out->num_from);
        out->channels[i] = missing ? 0 : channel;
        is_complete = is_complete && !missing;
    }
    bool has_channels = out->num_from && out->num_to;
    if (has_channels && !is_complete)
        diag_add(u->diags, DIAG_ID_unknown_channel, place, out->num_to,
                 str_text(u->doc->strings, from), text);
    return has_channels;
}

static bool is_constant(const struct selection *s)
{
    for (unsigned i = 0; i < s->num_to; i++)
        if (s->channels[i] < CHANNEL_ZERO)
            return false;
    return true;
}

/* True if <convert> is equivalent: all channels in order, or one float in all channels. */
static bool is_conversion(const struct selection *s)
{
    if (s->num_from == 1 && s->num_to == 4)
        return false; /* <convert> to color4 sets alpha to 1 */
    for (unsigned i = 0; i < s->num_to; i++)
        if (s->channels[i] != (s->num_from == 1 ? 0 : i))
            return false;
    return s->num_to <= s->num_from || s->num_from == 1;
}

static const char *output_of(str_id type, unsigned channel)
{
    assert(channel < MAX_CHANNELS);
    static const char *const color[] = {"outr", "outg", "outb", "outa"}, *const vector[] = {
                                                                             "outx", "outy", "outz",
                                                                             "outw"};
    return (type == STR_color3 || type == STR_color4 ? color : vector)[channel];
}

static const char *combine_input(unsigned channel)
{
    assert(channel < MAX_CHANNELS);
    static const char *const inputs[] = {"in1", "in2", "in3", "in4"};
    return inputs[channel];
}

/* Adds the inputs of <combineN>, connected to a float or to the outputs of <separateN>. */
static void add_combine_inputs(struct upgrade *u, elem_id node, const struct selection *s,
                               elem_id in)
{
    assert(s->num_to >= 2 && s->num_to <= MAX_CHANNELS);
    char category[] = "separate0";
    category[8] = (char)('0' + s->num_from);
    elem_id separate = 0;
    for (unsigned i = 0; i < s->num_to; i++) {
        if (s->channels[i] >= CHANNEL_ZERO) {
            upgrade_add_input(u, node, combine_input(i), STR_float,
                              upgrade_word(u, s->channels[i] == CHANNEL_ONE ? "1.0" : "0.0"));
        } else if (s->num_from == 1) {
            upgrade_copy_input(u, in, node, combine_input(i), "float");
        } else {
            if (!separate) {
                separate = upgrade_add_node(u, node, "separate", category, STR_multioutput);
                upgrade_copy_input(u, in, separate, "in", str_text(u->doc->strings, s->from));
            }
            upgrade_connect(u, upgrade_add_input(u, node, combine_input(i), STR_float, STR_EMPTY),
                            separate, output_of(s->from, s->channels[i]));
        }
    }
}

/* Selects components of a value of the source type: "0.1, 0.2, 0.3" by bgr. */
static str_id select_value(struct upgrade *u, const struct selection *s, str_id value)
{
    struct strpool *strings = u->doc->strings;
    struct ir_value in = {0};
    bool known = doc_parse_value(doc_type_of(s->from), str_text(strings, value),
                                 str_len(strings, value), NULL, &in);
    struct text text;
    text_init(&text, u->doc->arena);
    for (unsigned i = 0; i < s->num_to; i++) {
        unsigned channel = s->channels[i];
        assert(channel < CHANNEL_BAD);
        float component = channel == CHANNEL_ONE            ? 1.0f
                          : channel < CHANNEL_ZERO && known ? in.w[channel].f
                                                            : 0.0f;
        text_str(&text, i ? ", " : "");
        text_float(&text, component);
    }
    return str_intern(strings, text.data, text.len);
}

/*
 * True if the numbers of a value are not those that its node reads: a colour has a space, of `in`
 * or of the elements around `node`; a number has a unit.
 */
static bool is_converted(const struct document *doc, elem_id node, const struct selection *s,
                         elem_id in)
{
    str_id space = doc_attr_value(doc, in, STR_colorspace);
    space = space ? space : doc_inherited_attr(doc, node, STR_colorspace);
    return doc_attr_value(doc, in, STR_unit)
           || (doc_type_is_color(doc_type_of(s->from)) && space && space != STR_none);
}

/*
 * Makes `node`, which has no inputs, compute a selection from the binding of the port `in` (0: no
 * binding, so the value 0).
 */
static void build_selection(struct upgrade *u, elem_id node, const struct selection *s, elem_id in)
{
    struct document *doc = u->doc;
    assert(!doc_element(doc, node)->first_child);
    bool connected = in && doc_is_connected(u->doc, in);
    str_id own_space = in ? doc_attr_value(doc, node, STR_colorspace) : STR_EMPTY;
    if (own_space && !doc_attr(doc, in, STR_colorspace)) /* nodes beside this one lack it */
        doc_set_attr(doc, in, STR_colorspace, own_space);
    char combine[] = "combine0";
    combine[7] = (char)('0' + s->num_to);
    if (is_constant(s) || !in || (!connected && !is_converted(doc, node, s, in))) {
        str_id value = in && !connected ? doc_attr_value(doc, in, STR_value) : STR_EMPTY;
        upgrade_set_category(u, node, "constant");
        upgrade_keep_numbers(u,
                             upgrade_add_input(u, node, "value", s->to, select_value(u, s, value)));
    } else if (s->num_to == 1 && s->num_from > 1) {
        static const char *const indices[] = {"0", "1", "2", "3"};
        assert(s->channels[0] < s->num_from);
        upgrade_set_category(u, node, "extract");
        upgrade_copy_input(u, in, node, "in", str_text(doc->strings, s->from));
        upgrade_add_input(u, node, "index", STR_integer, upgrade_word(u, indices[s->channels[0]]));
    } else if (is_conversion(s)) {
        upgrade_set_category(u, node, s->from == s->to ? "dot" : "convert");
        upgrade_copy_input(u, in, node, "in", str_text(doc->strings, s->from));
    } else {
        upgrade_set_category(u, node, combine);
        add_combine_inputs(u, node, s, in);
    }
}

/* Derives the unknown type of a connection from the letters of `channels`. */
static str_id guess_type(const struct upgrade *u, str_id channels, str_id to)
{
    static const struct {
        const char *channels;
        str_id type;
    } telling[] = {
        {"xx", STR_float},    {"xxx", STR_float},   {"xxxx", STR_float},
        {"xyz", STR_vector3}, {"x", STR_vector3},   {"y", STR_vector3},
        {"z", STR_vector3},   {"rgba", STR_color4}, {"a", STR_color4},
    };
    for (size_t i = 0; i < sizeof telling / sizeof *telling; i++)
        if (upgrade_is(u, channels, telling[i].channels))
            return telling[i].type;
    return to == STR_color3 ? STR_color4 : STR_color3;
}

/* An input has a node around it. One at the top, which validation reports, has not. */
static bool is_port(const struct upgrade *u, elem_id element)
{
    const struct element *e = doc_element(u->doc, element);
    bool is_input = e->kind == KIND_INPUT && e->parent && doc_element(u->doc, e->parent)->parent;
    return is_input || (e->kind == KIND_OUTPUT && e->parent);
}

static void upgrade_port_channels(struct upgrade *u, elem_id port, str_id channels)
{
    assert(is_port(u, port));
    struct document *doc = u->doc;
    str_id to = doc_attr_value(doc, port, STR_type), from = upgrade_upstream_type(u, port);
    struct selection s;
    from = channel_count(from) ? from : guess_type(u, channels, to);
    bool is_output = doc_element(doc, port)->kind == KIND_OUTPUT;
    struct diag_place place = doc_attr_place(doc, port, STR_channels);
    doc_remove_attr(doc, port, STR_channels);
    if (!doc_is_connected(u->doc, port) || !read_selection(u, from, to, channels, place, &s))
        return;
    upgrade_note(u, port, "channels=\"%s\" is now a node", str_text(doc->strings, channels));
    if (s.num_from == 1 && s.num_to == 1)
        return;
    elem_id node = upgrade_add_node(u, is_output ? port : doc_element(doc, port)->parent,
                                    "channels", "convert", to);
    doc_remove_attr(doc, port, STR_value); /* a connection takes precedence */
    build_selection(u, node, &s, port);
    upgrade_connect(u, port, node, NULL);
}

void upgrade_channels(struct upgrade *u)
{
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        str_id channels = is_port(u, e) ? doc_attr_value(u->doc, e, STR_channels) : STR_EMPTY;
        if (channels)
            upgrade_port_channels(u, e, channels);
    }
}

void upgrade_swizzles(struct upgrade *u)
{
    struct document *doc = u->doc;
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        if (!upgrade_is_node(u, e) || !upgrade_is_category(u, e, "swizzle"))
            continue;
        elem_id in = upgrade_child(u, e, "in"), channels = upgrade_child(u, e, "channels");
        str_id from = in ? doc_attr_value(doc, in, STR_type) : STR_float,
               to = doc_attr_value(doc, e, STR_type);
        str_id letters = channels ? doc_attr_value(doc, channels, STR_value) : STR_EMPTY;
        struct diag_place place =
            channels ? doc_attr_place(doc, channels, STR_value) : doc_place(doc, e);
        struct selection s;
        if ((channels && doc_is_connected(u->doc, channels))
            || !read_selection(u, from, to, letters, place, &s))
            continue; /* 1.39 has no equivalent node: it is reported as unknown */
        while (doc_element(doc, e)->first_child)
            doc_remove_element(doc, doc_element(doc, e)->first_child);
        build_selection(u, e, &s, in);
        upgrade_note(u, e, "<swizzle> is now <%s>",
                     str_text(doc->strings, doc_element(doc, e)->category));
    }
}

/* 1.38: color2 became vector2, so the channels r and a become x and y. */

static str_id rename_channels(struct upgrade *u, str_id channels)
{
    struct text text;
    text_init(&text, u->doc->arena);
    const char *p = str_text(u->doc->strings, channels);
    for (; *p; p++)
        text_char(&text, *p == 'r' ? 'x' : *p == 'a' ? 'y' : *p);
    return str_intern(u->doc->strings, text.data, text.len);
}

/* True if the node separates color2, the type of its input "in". */
static bool takes_color2(const struct upgrade *u, elem_id node)
{
    elem_id in = upgrade_child(u, node, "in");
    return in && upgrade_is(u, doc_attr_value(u->doc, in, STR_type), "color2");
}

void upgrade_color2_channels(struct upgrade *u)
{
    struct document *doc = u->doc;
    if (!str_find(doc->strings, "color2", 6))
        return;
    for (elem_id e = upgrade_first(u); e; e = upgrade_next(u, e)) {
        if (upgrade_is_node(u, e) && upgrade_is_category(u, e, "swizzle") && takes_color2(u, e)) {
            elem_id channels = upgrade_child(u, e, "channels");
            if (channels)
                doc_set_attr(doc, channels, STR_value,
                             rename_channels(u, doc_attr_value(doc, channels, STR_value)));
        }
        if (!is_port(u, e))
            continue;
        str_id channels = doc_attr_value(doc, e, STR_channels),
               output = doc_attr_value(doc, e, STR_output);
        elem_id upstream = upgrade_upstream(u, e);
        if (channels && upgrade_is(u, upgrade_upstream_type(u, e), "color2"))
            doc_set_attr(doc, e, STR_channels, rename_channels(u, channels));
        if (output && upstream && upgrade_is_category(u, upstream, "separate2")
            && takes_color2(u, upstream))
            doc_set_attr(doc, e, STR_output,
                         upgrade_word(u, upgrade_is(u, output, "outr") ? "outx" : "outy"));
    }
}
