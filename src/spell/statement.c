// SPDX-License-Identifier: Apache-2.0
/* Scheduled effects as statements. */
#include "spell/spell.h"

#include <assert.h>
#include <stdio.h>

void spell_open_line(struct spell *spell, unsigned indent, uint32_t origin)
{
    spell_mark(spell, origin);
    spell_indent(spell, indent);
}

static void write_assignment(struct spell *spell, unsigned indent, struct spell_name name,
                             const char *operator, ir_ref value)
{
    spell_open_line(spell, indent, ir_get(spell->shader->graph, value)->origin);
    spell_name(spell, name);
    spell_text(spell, operator);
    spell_expression(spell, value, LANG_PREC_ASSIGN);
    text_mem(spell->out, ";\n", 2);
}

/* "color += light;", or "pick -= share;" for the sum with a negative value. */
static void write_accumulation(struct spell *spell, unsigned indent, const struct effect *effect)
{
    const struct ir_graph *graph = spell->shader->graph;
    bool subtracts = ir_get(graph, effect->value)->op == IR_NEG && !spell->local_of[effect->value];
    write_assignment(spell, indent, spell->locals[effect->index], subtracts ? " -= " : " += ",
                     subtracts ? ir_arg(graph, effect->value, 0) : effect->value);
}

/* ---- Locals ---- */

/* Nodes of several layers of a stack often have one name: then the slot tells them apart. */
static struct spell_name with_slot(struct spell *spell, struct spell_name base, ir_ref ref)
{
    const struct shader *shader = spell->shader;
    str_id slot = shader->graph->origins.items[ir_get(shader->graph, ref)->origin].slot;
    if (!slot || shader->interface.rules.neutral_names
        || names_is_free(&spell->names, base.text, base.len))
        return base;
    struct text text;
    size_t len;
    text_init(&text, spell->scratch);
    text_mem(&text, base.text, base.len);
    text_char(&text, '_');
    text_mem(&text, str_text(shader->strings, slot), str_len(shader->strings, slot));
    const char *name = identifier_from(text_cstr(&text), text.len, spell->scratch, &len);
    return (struct spell_name){name, len};
}

/* The name of a result of `ref`. */
static struct spell_name add_local(struct spell *spell, struct spell_name base, ir_ref ref)
{
    base = with_slot(spell, base, ref);
    struct spell_name name = names_unique(&spell->names, base.text, base.len);
    vec_push(spell->scratch, &spell->let_names, name);
    return name;
}

/* "metal_ior" for the part "ior" of the results of a call. */
static struct spell_name part_name(struct spell *spell, struct spell_name base, const char *part)
{
    if (!part || spell->shader->interface.rules.neutral_names)
        return base;
    struct text text;
    text_init(&text, spell->scratch);
    text_mem(&text, base.text, base.len);
    text_char(&text, '_');
    text_str(&text, part);
    return (struct spell_name){text_cstr(&text), text.len};
}

/*
 * A comment names the document node or graph that the following nodes are inside of. The nodes' own
 * names are in the names of the locals. All nodes of one parent are in one graph, so the speller
 * asks for a path once per parent.
 */
static void write_path(struct spell *spell, unsigned indent, uint32_t origin)
{
    const struct spell_options *options = spell->options;
    if (!spell->origins_seen || !origin)
        return;
    uint32_t parent = spell->shader->graph->origins.items[origin].parent,
             key = parent ? parent : origin;
    if (spell->origins_seen[key])
        return;
    spell->origins_seen[key] = 1;
    const char *path = options->path(options->user_data, origin),
               *end = path ? strrchr(path, '/') : NULL;
    if (!end || !names_take(&spell->paths, path, (size_t)(end - path)))
        return;
    spell_indent(spell, indent);
    text_mem(spell->out, "// ", 3);
    spell_comment(spell, path, (size_t)(end - path));
    text_char(spell->out, '\n');
}

/* "color c": the local of a node, or of one of its results. */
static void write_typed(struct spell *spell, enum lang_phrase phrase, ir_ref ref, ir_type_id type,
                        struct spell_name name)
{
    const char *own_type = spell->target->node_type ? spell->target->node_type(spell, ref) : NULL;
    struct lang_type_text text =
        own_type ? (struct lang_type_text){lang_word(own_type), 0} : spell_type_text(spell, type);
    if (spell_is_half(spell, ref))
        text.name = spell_half_type(spell, type);
    (void)lang_open(spell->style, phrase, text, spell_word(name), spell->out);
}

/* ---- Calls with several results ---- */

struct call_out {
    ir_type_id type;
    const char *part; /* name of the `out` parameter */
    bool inout;
};

static struct call_out portable_out(const struct spell *spell, ir_ref call, unsigned index)
{
    const struct lang_unit *layer;
    const struct lang_function *fn =
        lang_function(spell->shader->unit, shader_callee(spell->shader, call), &layer);
    for (uint32_t i = 0;; i++) {
        assert(i < fn->num_params);
        const struct lang_slot *slot = &layer->slots.items[fn->first_slot + i];
        if (slot->mode != LANG_IN && index-- == 0)
            return (struct call_out){slot->type, str_text(spell->shader->strings, slot->name),
                                     slot->mode == LANG_INOUT};
    }
}

static struct call_out describe_out(const struct spell *spell, ir_ref call, unsigned index)
{
    const struct shader *shader = spell->shader;
    const struct ir_node *node = ir_get(shader->graph, call);
    if (node->op == IR_CALL)
        return portable_out(spell, call, index);
    if (node->op == IR_GRAPH_CALL) {
        const struct ir_function *fn = &shader->graph->functions.items[node->attr];
        assert(index + 1 < fn->num_results);
        return (struct call_out){
            ir_type_of(shader->graph,
                       shader->graph->function_results.items[fn->first_result + index + 1]),
            "result", false};
    }
    const struct shader_verbatim *verbatim =
        &shader->sources.calls.items[shader_callee(shader, call)];
    assert(index < verbatim->num_results);
    return (struct call_out){shader->sources.result_types.items[verbatim->first_result + index],
                             verbatim->result_names ? verbatim->result_names[index] : "result",
                             verbatim->has_initial};
}

/* The argument for a result, which is a local: "x", "&x". */
static void write_reference(struct spell *spell, struct spell_name local)
{
    lang_put_phrase(spell->style->phrases[PHRASE_REFERENCE], spell_word(local), spell->out);
}

/*
 * Portable functions have `in`, `inout` and `out` parameters in any order. The operands of the call
 * belong to the first two kinds. An `inout` argument is a local that starts with the value of the
 * operand.
 */
static void write_portable_arguments(struct spell *spell, ir_ref call, uint32_t first_name)
{
    const struct lang_unit *layer;
    const struct lang_function *fn =
        lang_function(spell->shader->unit, shader_callee(spell->shader, call), &layer);
    uint32_t operand = 0, out = 0;
    bool is_first = true;
    for (uint32_t i = 0; i < fn->num_params; i++) {
        uint8_t mode = layer->slots.items[fn->first_slot + i].mode;
        bool in_struct = spell->style->syntax->results_in_struct;
        out += in_struct && mode != LANG_IN;
        if (in_struct && mode == LANG_OUT)
            continue;
        text_str(spell->out, is_first ? "" : ", ");
        is_first = false;
        if (mode == LANG_IN || in_struct)
            spell_argument(spell, ir_arg(spell->shader->graph, call, operand));
        else
            write_reference(spell, spell->let_names.items[first_name + 1 + out++]);
        operand += mode != LANG_OUT;
    }
    assert(operand == ir_get(spell->shader->graph, call)->num_args);
    assert(out == shader_call_outs(spell->shader, call));
}

static void write_call_arguments(struct spell *spell, ir_ref call, uint32_t first_name,
                                 unsigned outs)
{
    if (ir_get(spell->shader->graph, call)->op == IR_CALL) {
        spell_text(spell, spell_function_name(spell, shader_callee(spell->shader, call)));
        text_char(spell->out, '(');
        write_portable_arguments(spell, call, first_name);
        return;
    }
    unsigned written = spell_call_open(spell, call);
    for (unsigned i = 0; i < outs; i++) {
        if (written++)
            text_mem(spell->out, ", ", 2);
        write_reference(spell, spell->let_names.items[first_name + 1 + i]);
    }
}

/* The operand of an `inout` parameter, by its index among the `out` and `inout` parameters. */
static ir_ref inout_operand(const struct spell *spell, ir_ref call, unsigned index)
{
    const struct ir_node *node = ir_get(spell->shader->graph, call);
    if (node->op == IR_VERBATIM)
        return ir_arg(spell->shader->graph, call,
                      node->num_args - shader_call_outs(spell->shader, call) + index);
    const struct lang_unit *layer;
    const struct lang_function *fn =
        lang_function(spell->shader->unit, shader_callee(spell->shader, call), &layer);
    uint32_t operand = 0;
    for (uint32_t i = 0;; i++) {
        assert(i < fn->num_params);
        uint8_t mode = layer->slots.items[fn->first_slot + i].mode;
        if (mode != LANG_IN && index-- == 0)
            return ir_arg(spell->shader->graph, call, operand);
        operand += mode != LANG_OUT;
    }
}

/* "metal" for a call "metal_ior" with a result "ior", so that no name repeats the word. */
static struct spell_name parts_base(struct spell *spell, ir_ref call, unsigned outs)
{
    struct spell_name base = spell_call_base(spell, call);
    for (unsigned i = 0; i < outs; i++) {
        const char *part = describe_out(spell, call, i).part;
        size_t len = strlen(part);
        if (base.len > len + 1 && base.text[base.len - len - 1] == '_'
            && memcmp(base.text + base.len - len, part, len) == 0)
            return (struct spell_name){base.text, base.len - len - 1};
    }
    return base;
}

/* Writes "float x, y;", and a separate declaration for each `inout` argument. */
static void declare_outs(struct spell *spell, unsigned indent, ir_ref call, unsigned outs)
{
    const struct lang_syntax *syntax = spell->target->syntax;
    const struct ir_node *node = ir_get(spell->shader->graph, call);
    struct spell_name base =
        outs > 1 ? parts_base(spell, call, outs) : spell_call_base(spell, call);
    struct call_out last = {0};
    for (unsigned i = 0; i < outs; i++) {
        struct call_out out = describe_out(spell, call, i);
        bool is_whole = node->type == IR_TYPE_VOID && outs == 1;
        struct spell_name name =
            add_local(spell, part_name(spell, base, is_whole ? NULL : out.part), call);
        bool joins = i > 0 && !out.inout && !last.inout && out.type == last.type
                     && out.type < IR_TYPE_FIRST_USER && !syntax->one_per_declaration;
        if (joins) {
            text_mem(spell->out, ", ", 2);
            spell_name(spell, name);
        } else {
            if (i > 0)
                text_mem(spell->out, ";\n", 2);
            spell_open_line(spell, indent, node->origin);
            write_typed(spell, PHRASE_LOCAL, call, out.type, name);
        }
        if (out.inout) {
            text_mem(spell->out, " = ", 3);
            spell_expression(spell, inout_operand(spell, call, i), LANG_PREC_ASSIGN);
        }
        last = out;
    }
    text_mem(spell->out, ";\n", 2);
}

/* "mdl_r1.a": a result of a call that returns a struct. */
static void name_member(struct spell *spell, struct spell_name made, const char *member)
{
    struct text text;
    text_init(&text, spell->scratch);
    text_mem(&text, made.text, made.len);
    text_fmt(&text, ".%s", member);
    vec_push(spell->scratch, &spell->let_names, (struct spell_name){text_cstr(&text), text.len});
}

/* The member of the struct for a result; those of a graph's function are "r1", "r2". */
static const char *member_of(struct spell *spell, ir_ref call, unsigned index)
{
    if (ir_get(spell->shader->graph, call)->op != IR_GRAPH_CALL)
        return lang_member_name(
            spell->style, spell->shader->strings,
            str_intern_z(spell->shader->strings, describe_out(spell, call, index).part));
    struct text text;
    text_init(&text, spell->scratch);
    text_fmt(&text, "r%u", index + 1);
    return text_cstr(&text);
}

/* "mdl_results_f metal = f(x);" */
static void write_struct_let(struct spell *spell, unsigned indent, ir_ref call, unsigned outs)
{
    const struct ir_node *node = ir_get(spell->shader->graph, call);
    struct spell_name base = with_slot(spell, spell_call_base(spell, call), call),
                      made = names_unique(&spell->names, base.text, base.len);
    const char *function = node->op == IR_CALL
                               ? spell_function_name(spell, shader_callee(spell->shader, call))
                               : spell->graph_functions[node->attr];
    uint32_t first = spell->let_names.len;
    name_member(spell, made, LANG_RESULTS_VALUE);
    for (unsigned i = 0; i < outs; i++)
        name_member(spell, made, member_of(spell, call, i));
    spell_open_line(spell, indent, node->origin);
    SPELL(spell, lang_results_name(spell->style->syntax, function, spell->scratch), " ", made.text,
          " = ");
    if (node->op == IR_CALL)
        write_call_arguments(spell, call, first, outs);
    else
        (void)spell_call_open(spell, call);
    text_mem(spell->out, ");\n", 3);
    spell->local_of[call] = first + 1;
}

static void write_call_let(struct spell *spell, unsigned indent, ir_ref call, unsigned outs)
{
    const struct ir_node *node = ir_get(spell->shader->graph, call);
    uint32_t first = spell->let_names.len;
    if (spell->style->syntax->results_in_struct) {
        write_struct_let(spell, indent, call, outs);
        return;
    }
    if (node->type == IR_TYPE_VOID)
        vec_push(spell->scratch, &spell->let_names, (struct spell_name){0});
    else
        (void)add_local(spell, spell_call_base(spell, call), call);
    declare_outs(spell, indent, call, outs);
    assert(spell->let_names.len == first + 1 + outs);
    spell_open_line(spell, indent, node->origin);
    if (node->type != IR_TYPE_VOID) {
        spell_variable(spell, PHRASE_VALUE, node->type, spell->let_names.items[first]);
        text_mem(spell->out, " = ", 3);
    }
    write_call_arguments(spell, call, first, outs);
    text_mem(spell->out, ");\n", 3);
    spell->local_of[call] = first + 1;
}

static void write_let(struct spell *spell, unsigned indent, ir_ref ref)
{
    assert(spell->local_of[ref] == 0);
    const struct ir_node *node = ir_get(spell->shader->graph, ref);
    write_path(spell, indent, node->origin);
    if (node->op == IR_CALL || node->op == IR_VERBATIM || node->op == IR_GRAPH_CALL) {
        unsigned outs = shader_call_outs(spell->shader, ref);
        if (outs) {
            write_call_let(spell, indent, ref, outs);
            return;
        }
    }
    struct spell_name name = add_local(spell, spell_local_base(spell, ref), ref);
    spell_open_line(spell, indent, node->origin);
    write_typed(spell, node->op == IR_CONST ? PHRASE_LOCAL_CONSTANT : PHRASE_VALUE, ref, node->type,
                name);
    text_mem(spell->out, " = ", 3);
    spell_value(spell, ref);
    text_mem(spell->out, ";\n", 2);
    spell->local_of[ref] = spell->let_names.len;
}

/* ---- Other effects ---- */

/* The name of a private uniform of the shader. */
static const char *private_name(const struct spell *spell, str_id asked)
{
    uint32_t variable = shader_asked_uniform(spell->shader, asked);
    assert(variable < spell->shader->interface.variables.len);
    return spell->variables[variable].text;
}

/*
 * Over all lights from the last one: a driver that knows a loop's first number unrolls it, which
 * makes the shader by a third longer and no faster.
 */
static void write_last_light(struct spell *spell)
{
    if (spell->shader->lights == LIGHTS_OF_HOST) {
        SPELL(spell, spell_host_prefix(spell), "mxg_light_count() - 1");
        return;
    }
    SPELL(spell, "min(", private_name(spell, STR_u_numActiveLightSources), ", ");
    spell_number(spell, spell->shader->interface.max_lights);
    spell_text(spell, ") - 1");
}

/* "turn", or "coat_turn" where another loop beside this one has that name. */
static struct spell_name turn_name(struct spell *spell, str_id leaf)
{
    static const char turn[] = "turn";
    size_t len = strlen(turn);
    if (!leaf || spell->shader->interface.rules.neutral_names
        || names_is_free(&spell->names, turn, len))
        return names_unique(&spell->names, turn, len);
    struct text name;
    text_init(&name, spell->scratch);
    text_fmt(&name, "%s_%s", str_text(spell->shader->strings, leaf), turn);
    const char *identifier = identifier_from(text_cstr(&name), name.len, spell->scratch, &len);
    return names_unique(&spell->names, identifier, len);
}

/* The turn is carried from sample to sample. */
static void write_first_turn(struct spell *spell, unsigned indent, const struct effect *effect)
{
    spell->loop_turn = turn_name(spell, effect->text);
    spell_open_line(spell, indent, 0);
    spell_variable(spell, PHRASE_LOCAL, IR_TYPE_VEC2, spell->loop_turn);
    text_mem(spell->out, " = ", 3);
    spell_expression(spell, effect->value, LANG_PREC_ASSIGN);
    text_mem(spell->out, ";\n", 2);
}

/*
 * A comment at the first occurrence of a text, and "text (2)" at the second: no two sections have
 * one name.
 */
static void write_comment(struct spell *spell, unsigned indent, str_id text)
{
    if (!spell->options->comments || spell->shader->interface.rules.neutral_names)
        return;
    struct text comment;
    text_init(&comment, spell->scratch);
    text_mem(&comment, str_text(spell->shader->strings, text),
             str_len(spell->shader->strings, text));
    size_t len = comment.len;
    for (uint32_t number = 2; !names_take(&spell->paths, text_cstr(&comment), comment.len);
         number++) {
        comment.len = len;
        text_fmt(&comment, " (%u)", (unsigned)number);
    }
    spell_open_line(spell, indent, 0);
    text_mem(spell->out, "// ", 3);
    spell_comment(spell, comment.data, comment.len);
    text_char(spell->out, '\n');
}

static void explain_order(struct spell *spell, unsigned indent)
{
    if (!spell->options->comments || spell->shader->interface.rules.neutral_names)
        return;
    spell_open_line(spell, indent, 0);
    spell_text(spell, "// from the last light, so that drivers do not unroll the loop\n");
}

/* A part of the loop's head: '0' its start, '1' its condition, '2' its step. */
static void write_loop_part(struct spell *spell, const struct effect *effect, char part)
{
    struct spell_name i = {spell->loop_index, strlen(spell->loop_index)};
    bool lights = effect->kind == EFFECT_LIGHTS;
    if (part == '2') {
        lang_put_phrase(spell->style->phrases[lights ? PHRASE_DECREMENT : PHRASE_INCREMENT],
                        spell_word(i), spell->out);
    } else if (part == '1') {
        SPELL(spell, i.text, lights ? " >= 0" : " < ");
        if (!lights)
            spell_expression(spell, effect->value, LANG_PREC_SHIFT);
    } else {
        spell_variable(spell, PHRASE_LOCAL, IR_TYPE_INT, i);
        spell_text(spell, " = ");
        if (lights)
            write_last_light(spell);
        else
            spell_text(spell, "0");
    }
}

static void write_loop(struct spell *spell, unsigned indent, const struct effect *effect)
{
    if (!spell->loop_index)
        spell->loop_index = names_unique(&spell->names, "i", 1).text;
    if (effect->kind == EFFECT_LIGHTS)
        explain_order(spell, indent);
    spell_open_line(spell, indent, 0);
    const char *rest = spell->style->phrases[PHRASE_FOR];
    for (char part; (part = lang_next(&rest, spell->out));)
        write_loop_part(spell, effect, part);
    spell_text(spell, " {\n");
}

void spell_if(struct spell *spell, unsigned indent, ir_ref condition, bool braces)
{
    spell_open_line(spell, indent, ir_get(spell->shader->graph, condition)->origin);
    text_mem(spell->out, "if (", 4);
    spell_expression(spell, condition, LANG_PREC_ASSIGN);
    text_str(spell->out, braces ? ") {\n" : ")\n");
}

static void write_discard(struct spell *spell, unsigned indent, ir_ref condition)
{
    bool braces = condition && spell->style->syntax->always_braces;
    if (condition)
        spell_if(spell, indent++, condition, braces);
    spell_open_line(spell, indent, 0);
    SPELL(spell, spell->style->phrases[PHRASE_DISCARD], ";\n");
    if (!braces)
        return;
    spell_open_line(spell, indent - 1, 0);
    spell_text(spell, "}\n");
}

static void write_variable(struct spell *spell, unsigned indent, const struct effect *effect)
{
    assert(effect->index < spell->shader->effects.locals.len);
    const struct shader_local *local = &spell->shader->effects.locals.items[effect->index];
    struct spell_name name = spell->shader->interface.rules.neutral_names
                                 ? (struct spell_name){"v", 1}
                                 : spell_name_of(spell->shader->strings, local->name);
    spell->locals[effect->index] = names_unique(&spell->names, name.text, name.len);
    spell_open_line(spell, indent, 0);
    spell_variable(spell, PHRASE_LOCAL, local->type, spell->locals[effect->index]);
    if (effect->value) {
        text_mem(spell->out, " = ", 3);
        spell_expression(spell, effect->value, LANG_PREC_ASSIGN);
    }
    text_mem(spell->out, ";\n", 2);
}

/* "return mdl_results_f(x, r1)": a graph's function with several results in a struct. */
static void write_return_struct(struct spell *spell, unsigned indent, const struct effect *effect)
{
    spell_open_line(spell, indent, 0);
    SPELL(spell, "return ", spell->graph_results, "(");
    spell_expression(spell, effect->value, lang_argument_level(spell->style->syntax));
    for (uint32_t i = 1; i < spell->num_graph_results; i++)
        text_fmt(spell->out, ", r%u", (unsigned)i);
    spell_text(spell, ");\n");
}

static void write_result(struct spell *spell, unsigned indent, const struct effect *effect)
{
    if (!effect->index && spell->graph_results) {
        write_return_struct(spell, indent, effect);
        return;
    }
    if (!effect->index) {
        write_assignment(spell, indent, (struct spell_name){"return", 6}, " ", effect->value);
        return;
    }
    char number[16];
    struct text name;
    size_t len = (size_t)snprintf(number, sizeof number, "r%u", (unsigned)effect->index);
    text_init(&name, spell->scratch);
    lang_put_phrase(spell->graph_results ? "$0" : spell->style->phrases[PHRASE_REFERENCED],
                    (struct text_word){number, len}, &name);
    write_assignment(spell, indent, (struct spell_name){text_cstr(&name), name.len}, " = ",
                     effect->value);
}

static struct spell_name position_name(const struct spell *spell)
{
    struct text name;
    text_init(&name, spell->scratch);
    const char *position = spell->target->position ? spell->target->position : "gl_Position";
    text_fmt(&name, "%s%s", *position == '.' ? spell_frame_name(spell, "vd") : "", position);
    return (struct spell_name){text_cstr(&name), name.len};
}

void spell_effect(struct spell *spell, unsigned indent, const struct effect *effect)
{
    switch ((enum effect_kind)effect->kind) {
    case EFFECT_LET: write_let(spell, indent, effect->value); break;
    case EFFECT_VAR: write_variable(spell, indent, effect); break;
    case EFFECT_ACCUMULATE: write_accumulation(spell, indent, effect); break;
    case EFFECT_ASSIGN:
        write_assignment(spell, indent, spell->locals[effect->index], " = ", effect->value);
        break;
    case EFFECT_OUTPUT:
        write_assignment(spell, indent, spell->variables[effect->index], " = ", effect->value);
        break;
    case EFFECT_POSITION:
        write_assignment(spell, indent, position_name(spell), " = ", effect->value);
        break;
    case EFFECT_TURN: write_first_turn(spell, indent, effect); break;
    case EFFECT_LIGHTS:
    case EFFECT_SAMPLES: write_loop(spell, indent, effect); break;
    case EFFECT_NEXT:
        write_assignment(spell, indent, spell->loop_turn, " = ", effect->value);
        break;
    case EFFECT_COMMENT: write_comment(spell, indent, effect->text); break;
    case EFFECT_DISCARD: write_discard(spell, indent, effect->value); break;
    case EFFECT_RESULT: write_result(spell, indent, effect); break;
    case EFFECT_IF:
    case EFFECT_ELSE:
    case EFFECT_END: /* block.c */ break;
    }
}

/* A parameter of a graph's function: "p0", or "r1" of its second result. */
static void write_parameter(struct spell *spell, enum lang_phrase phrase, ir_type_id type,
                            const char *letter, uint32_t index)
{
    struct text name;
    text_init(&name, spell->scratch);
    text_str(&name, letter);
    text_u32(&name, index);
    struct text_word own = {text_cstr(&name), name.len};
    names_take(&spell->names, own.bytes, own.len);
    bool is_texture = type == IR_TYPE_SAMPLER || type == IR_TYPE_SAMPLER_ARRAY;
    (void)lang_open(spell->style, type == IR_TYPE_SAMPLER ? PHRASE_PLAIN : phrase,
                    spell_type_text(spell, type), own, spell->out);
    if (is_texture)
        lang_put_sampler(spell->style, own, spell->out);
}

/* The struct of the results of a graph's function: "value", "r1", "r2". */
static void write_results_struct(struct spell *spell, const ir_ref *results)
{
    SPELL(spell, "struct ", spell->graph_results, " {\n");
    for (uint32_t i = 0; i < spell->num_graph_results; i++) {
        struct text name;
        text_init(&name, spell->scratch);
        text_fmt(&name, i ? "r%u" : LANG_RESULTS_VALUE, (unsigned)i);
        spell_indent(spell, 1);
        spell_variable(spell, PHRASE_MEMBER, ir_type_of(spell->shader->graph, results[i]),
                       (struct spell_name){text_cstr(&name), name.len});
        spell_text(spell, "\n");
    }
    SPELL(spell, spell->style->phrases[PHRASE_STRUCT_END], "\n");
}

void spell_graph_function(struct spell *spell, const struct shader_function *function)
{
    assert(function->function < spell->shader->graph->functions.len);
    const struct ir_graph *graph = spell->shader->graph;
    const struct ir_function *fn = &graph->functions.items[function->function];
    const ir_ref *results = graph->function_results.items + fn->first_result;
    assert(fn->num_results > 0);
    const char *name = spell->graph_functions[function->function];
    bool in_struct = fn->num_results > 1 && spell->style->syntax->results_in_struct;
    spell->graph_results =
        in_struct ? lang_results_name(spell->style->syntax, name, spell->scratch) : NULL;
    spell->num_graph_results = fn->num_results;
    if (in_struct)
        write_results_struct(spell, results);
    names_open_scope(&spell->names);
    struct lang_type_text type = in_struct
                                     ? (struct lang_type_text){lang_word(spell->graph_results), 0}
                                     : spell_type_text(spell, ir_type_of(graph, results[0]));
    struct lang_declaration head =
        lang_open(spell->style, PHRASE_FUNCTION, type, lang_word(name), spell->out);
    for (uint32_t i = 0; i < fn->num_params; i++) {
        spell_text(spell, i ? ", " : "");
        write_parameter(spell, PHRASE_PARAM_IN, graph->param_types.items[fn->first_param_type + i],
                        "p", i);
    }
    spell_passed(spell, function->function, true, fn->num_params == 0);
    for (uint32_t i = 1; i < fn->num_results && !in_struct; i++) {
        spell_text(spell, fn->num_params || i > 1 ? ", " : "");
        write_parameter(spell, PHRASE_PARAM_OUT, ir_type_of(graph, results[i]), "r", i);
    }
    lang_declare(spell->style, &head, spell->out);
    text_mem(spell->out, "\n{\n", 3);
    for (uint32_t i = 1; i < fn->num_results && in_struct; i++) {
        spell_indent(spell, 1);
        write_parameter(spell, PHRASE_LOCAL, ir_type_of(graph, results[i]), "r", i);
        spell_text(spell, ";\n");
    }
    spell_statements(spell, &function->statements, 1);
    text_mem(spell->out, "}\n\n", 3);
}
