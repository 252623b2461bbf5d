// SPDX-License-Identifier: Apache-2.0
/*
 * Writes nodes as expressions. The scheduler bounds their depth (schedule.c), so this code may
 * recurse.
 */
#include "spell/spell.h"

#include <assert.h>
#include <ctype.h>

/*
 * Structs and arrays of the graph have their own ids. The struct of the portable functions with the
 * same name gives the name in the output.
 */
static const struct ir_user_type *user_type(const struct spell *spell, ir_type_id type)
{
    assert(type < IR_TYPE_FIRST_USER
           || type - IR_TYPE_FIRST_USER < (int)spell->shader->graph->user_types.len);
    return type < IR_TYPE_FIRST_USER
               ? NULL
               : &spell->shader->graph->user_types.items[type - IR_TYPE_FIRST_USER];
}

static const char *struct_name(const struct spell *spell, str_id name)
{
    const struct lang_reach *reach = &spell->stage->reach;
    for (uint32_t i = 0; i < reach->user_types.len; i++)
        if (lang_user_type(spell->shader->unit, reach->user_types.items[i], NULL)->name == name)
            return spell->user_types[reach->user_types.items[i] - IR_TYPE_FIRST_USER];
    return str_text(spell->shader->strings, name);
}

struct lang_type_text spell_type_text(const struct spell *spell, ir_type_id type)
{
    const struct ir_user_type *user = user_type(spell, type);
    uint32_t length = user ? user->array_length : 0;
    if (length) {
        type = user->element;
        user = user_type(spell, type);
    }
    return (struct lang_type_text){user ? lang_word(struct_name(spell, user->name))
                                        : lang_type_name(spell->style, &spell->lang_names, type),
                                   length};
}

void spell_type(struct spell *spell, ir_type_id type)
{
    lang_put_type(spell->style, spell_type_text(spell, type), spell->out);
}

void spell_variable(struct spell *spell, enum lang_phrase phrase, ir_type_id type,
                    struct spell_name name)
{
    (void)lang_open(spell->style, phrase, spell_type_text(spell, type), spell_word(name),
                    spell->out);
}

static void write_swizzle(struct spell *spell, ir_ref ref, uint32_t attr)
{
    assert(attr >> 8 >= 1 && attr >> 8 <= 4);
    ir_ref operand = ir_arg(spell->shader->graph, ref, 0);
    spell_expression(spell, operand, LANG_PREC_POSTFIX);
    text_char(spell->out, '.');
    for (uint32_t i = 0; i < attr >> 8; i++)
        text_char(spell->out, "xyzw"[attr >> 2 * i & 3]);
}

static void write_member(struct spell *spell, ir_ref ref, uint32_t attr)
{
    ir_ref operand = ir_arg(spell->shader->graph, ref, 0);
    spell_expression(spell, operand, LANG_PREC_POSTFIX);
    const struct ir_user_type *type = user_type(spell, ir_type_of(spell->shader->graph, operand));
    assert(attr < type->num_members);
    text_char(spell->out, '.');
    spell_text(spell, lang_member_name(
                          spell->style, spell->shader->strings,
                          spell->shader->graph->members.items[type->first_member + attr].name));
}

void spell_argument(struct spell *spell, ir_ref ref)
{
    const struct lang_syntax *syntax = spell->style->syntax;
    spell_expression(spell, ref, lang_argument_level(syntax));
    if (!spell_has_sampler(spell, ir_type_of(spell->shader->graph, ref)))
        return;
    text_mem(spell->out, ", ", 2);
    spell_expression(spell, ref, LANG_PREC_POSTFIX);
    spell_text(spell, LANG_SAMPLER_SUFFIX);
}

static void write_first(struct spell *spell, ir_ref ref, uint32_t n)
{
    for (uint32_t i = 0; i < n; i++) {
        if (i)
            text_mem(spell->out, ", ", 2);
        spell_argument(spell, ir_arg(spell->shader->graph, ref, i));
    }
}

static void write_list(struct spell *spell, ir_ref ref)
{
    write_first(spell, ref, ir_get(spell->shader->graph, ref)->num_args);
}

static void write_construct(struct spell *spell, ir_ref ref, ir_type_id type)
{
    const struct ir_user_type *user = user_type(spell, type);
    const struct lang_syntax *syntax = spell->target->syntax;
    bool is_struct = user && !user->array_length, is_array = user && !is_struct,
         braces = is_array ? syntax->array_braces : is_struct && syntax->struct_braces;
    const struct lang_names *names = &spell->lang_names;
    const char *maker = is_struct && names->maker
                            ? names->maker(names->user_data, struct_name(spell, user->name))
                            : NULL;
    if (maker)
        spell_text(spell, maker);
    else if (!is_array || !braces || spell->style->phrases[PHRASE_ARRAY])
        spell_type(spell, type);
    text_char(spell->out, braces ? '{' : '(');
    write_list(spell, ref);
    text_char(spell->out, braces ? '}' : ')');
}

enum { MAX_OPERANDS = 1 << 20 }; /* a bound of the numbers read */

/* The number of "{{number}}" at *p, which then moves past it; -1: there is none. */
static int read_operand(const char **p)
{
    const char *at = *p + 2;
    int index = 0;
    if (strncmp(*p, "{{", 2) != 0 || *at < '0' || *at > '9')
        return -1;
    for (; *at >= '0' && *at <= '9' && index < MAX_OPERANDS; at++)
        index = index * 10 + (*at - '0');
    if (strncmp(at, "}}", 2) != 0)
        return -1;
    *p = at + 2;
    return index;
}

static void write_verbatim(struct spell *spell, ir_ref ref, str_id expression);

static const char *callee_name(const struct spell *spell, ir_ref call)
{
    const struct ir_node *node = ir_get(spell->shader->graph, call);
    if (node->op == IR_GRAPH_CALL)
        return spell->graph_functions[node->attr];
    if (node->op == IR_LEAF)
        return str_text(spell->shader->strings,
                        spell->shader->graph->callees.items[node->attr].name);
    uint32_t callee = shader_callee(spell->shader, call);
    if (node->op == IR_VERBATIM)
        return spell_host_name(spell, spell->shader->sources.calls.items[callee].function);
    return spell_function_name(spell, callee);
}

/* The last operands of a verbatim call that are the values of its results before it. */
static uint32_t initial_operands(const struct spell *spell, ir_ref call)
{
    if (ir_get(spell->shader->graph, call)->op != IR_VERBATIM)
        return 0;
    const struct shader_verbatim *verbatim =
        &spell->shader->sources.calls.items[shader_callee(spell->shader, call)];
    return verbatim->has_initial ? verbatim->num_results : 0;
}

unsigned spell_call_open(struct spell *spell, ir_ref call)
{
    uint32_t n = ir_get(spell->shader->graph, call)->num_args - initial_operands(spell, call);
    spell_text(spell, callee_name(spell, call));
    text_char(spell->out, '(');
    write_first(spell, call, n);
    const struct ir_node *node = ir_get(spell->shader->graph, call);
    if (node->op == IR_GRAPH_CALL)
        spell_passed(spell, node->attr, false, n == 0);
    return n;
}

static void write_call(struct spell *spell, ir_ref ref)
{
    if (ir_get(spell->shader->graph, ref)->op == IR_VERBATIM) {
        const struct shader_verbatim *verbatim =
            &spell->shader->sources.calls.items[shader_callee(spell->shader, ref)];
        if (!verbatim->function) {
            write_verbatim(spell, ref, verbatim->expression);
            return;
        }
    }
    spell_call_open(spell, ref);
    text_char(spell->out, ')');
}

/* True if the text may repeat the operand. */
static bool is_named(const struct spell *spell, ir_ref ref)
{
    const struct ir_node *node = ir_get(spell->shader->graph, ref);
    uint8_t op = node->op;
    bool is_number =
        op == IR_CONST && node->type < IR_NUM_TYPES && ir_type_info(node->type)->components == 1;
    return is_number || spell->local_of[ref] || op == IR_UNIFORM || op == IR_STREAM
           || op == IR_PARAM || op == IR_LOCAL || op == IR_RESULT;
}

void spell_read(struct spell *spell, const struct shader_variable *variable, struct text_word name,
                enum lang_precedence least)
{
    const struct lang_form *form = &spell->style->syntax->block_bool_value;
    bool differs = shader_block_type(spell->shader, spell->style->syntax, variable),
         parentheses = differs && (enum lang_precedence)form->precedence < least;
    if (parentheses)
        text_char(spell->out, '(');
    lang_put_phrase(differs ? form->text : "$0", name, spell->out);
    if (parentheses)
        text_char(spell->out, ')');
}

/* Writes a node as its local, as a variable, or as an expression. */
static inline void write_plain(struct spell *spell, ir_ref ref, enum lang_precedence least)
{
    uint32_t local = spell->local_of[ref];
    const struct ir_node *node = &spell->shader->graph->nodes.items[ref];
    if (local)
        spell_name(spell, spell->let_names.items[local - 1]);
    else if (node->op == IR_UNIFORM && node->type == IR_TYPE_BOOL)
        spell_read(spell, &spell->shader->interface.variables.items[node->attr],
                   spell_word(spell->variables[node->attr]), least);
    else if (node->op == IR_UNIFORM || node->op == IR_STREAM)
        spell_name(spell, spell->variables[node->attr]);
    else
        spell->write_node(spell, ref, node, least);
}

/*
 * Writes a node in a language with types of half floats, and converts it to the floats of the text
 * around it: "vec3h(u_pub.tint)", "vec3f(tinted)". Constants take these types without conversion.
 */
static void write_converted(struct spell *spell, ir_ref ref, enum lang_precedence least)
{
    struct lang_style *around = spell->style;
    ir_type_id type = ir_type_of(spell->shader->graph, ref);
    bool is_float = ir_type_is_float(type) && !ir_type_is_matrix(type),
         is_constant = ir_get(spell->shader->graph, ref)->op == IR_CONST && !spell->local_of[ref];
    struct lang_style *own = is_float && is_constant           ? around
                             : spell_has_half_text(spell, ref) ? spell->half_style
                                                               : spell->whole_style;
    bool converts = is_float && own != around;
    if (converts) {
        spell_type(spell, type);
        text_char(spell->out, '(');
    }
    spell->style = own;
    write_plain(spell, ref, converts ? lang_argument_level(own->syntax) : least);
    spell->style = around;
    text_str(spell->out, converts ? ")" : "");
}

static inline void write_operand(struct spell *spell, ir_ref ref, enum lang_precedence least)
{
    if (spell->half_style)
        write_converted(spell, ref, least);
    else
        write_plain(spell, ref, least);
}

void spell_expression(struct spell *spell, ir_ref ref, enum lang_precedence least)
{
    write_operand(spell, ref, least);
}

void spell_value(struct spell *spell, ir_ref ref)
{
    struct lang_style *around = spell->style;
    if (spell->half_style && spell_is_half(spell, ref))
        spell->style = spell->half_style;
    spell_expression(spell, ref, LANG_PREC_ASSIGN);
    spell->style = around;
}

static void write_form(struct spell *spell, const struct ir_node *node,
                       const struct lang_pieces *form, enum lang_precedence least)
{
    assert(form->text);
    bool parentheses = (enum lang_precedence)form->precedence < least;
    const struct ir_graph *graph = spell->shader->graph;
    const ir_ref *args = graph->args.items + node->first_arg;
    if (lang_is_operand(form)) {
        write_operand(spell, args[0], least);
        return;
    }
    if (parentheses)
        text_char(spell->out, '(');
    const struct lang_piece *piece = form->pieces, *end = piece + form->num;
    for (; piece < end; piece++) {
        if (piece->before.len)
            text_put(spell->out, piece->before);
        if (piece->index == LANG_PIECE_TYPE)
            spell_type(spell, node->type);
        else
            write_operand(spell, args[piece->index],
                          lang_least(form, piece, graph->nodes.items[args[piece->index]].op));
    }
    if (form->rest.len)
        text_put(spell->out, form->rest);
    if (node->op == IR_TEX_SIZE && spell->target->syntax->sizes_count_layers
        && ir_type_of(spell->shader->graph, args[0]) == IR_TYPE_SAMPLER_ARRAY)
        spell_text(spell, ".xy"); /* the third component is the number of layers */
    if (parentheses)
        text_char(spell->out, ')');
}

/*
 * Writes ".x" of an operand that is no variable, in a language where only variables have parts;
 * false: the text after the operand needs no such form.
 */
static bool write_part(struct spell *spell, ir_ref ref, uint32_t index, const char **text)
{
    const struct ir_graph *graph = spell->shader->graph;
    ir_ref operand = ir_arg(graph, ref, index);
    ir_type_id type = ir_type_of(graph, operand);
    static const char parts[] = "xyzw";
    const char *p = *text,
               *letter = p[0] == '.' && p[1] && !isalnum((unsigned char)p[2]) && p[2] != '_'
                             ? strchr(parts, p[1])
                             : NULL;
    if (!letter || !spell->lang_names.form || is_named(spell, operand) || type >= IR_NUM_TYPES)
        return false;
    struct ir_node part = {.op = IR_SWIZZLE,
                           .type = ir_type_info(type)->scalar,
                           .num_args = 1,
                           .first_arg = ir_get(graph, ref)->first_arg + index,
                           .attr = 1u << 8 | (uint32_t)(letter - parts)};
    struct lang_use use = {.op = IR_SWIZZLE,
                           .type = part.type,
                           .attr = part.attr,
                           .operands = &type,
                           .num_operands = 1};
    const struct lang_pieces *form = spell->lang_names.form(spell->lang_names.user_data, &use);
    if (form)
        write_form(spell, &part, form, LANG_PREC_POSTFIX);
    *text += form ? 2 : 0;
    return form != NULL;
}

/* Writes the expression of verbatim source, with an operand in parentheses for each {{i}}. */
static void write_verbatim(struct spell *spell, ir_ref ref, str_id expression)
{
    const char *p = str_text(spell->shader->strings, expression);
    text_char(spell->out, '(');
    while (*p) {
        int index = read_operand(&p);
        if (index < 0) {
            text_char(spell->out, *p++);
            continue;
        }
        assert((uint32_t)index < ir_get(spell->shader->graph, ref)->num_args);
        if (write_part(spell, ref, (uint32_t)index, &p))
            continue;
        spell_expression(spell, ir_arg(spell->shader->graph, ref, (uint32_t)index),
                         LANG_PREC_POSTFIX);
    }
    text_char(spell->out, ')');
}

/* Writes the current light, a member of it, or its number. */
static void write_light(struct spell *spell, uint32_t attr, enum lang_precedence least)
{
    if (attr == IR_LIGHT_INDEX) {
        spell_text(spell, spell->loop_index);
        return;
    }
    struct text light;
    text_init(&light, spell->scratch);
    const char *instance = spell_instance(spell, BLOCK_LIGHT_DATA);
    if (instance)
        text_fmt(&light, "%s.", instance);
    text_fmt(&light, "%s[%s]", spell_frame_name(spell, "u_lightData"), spell->loop_index);
    if (!ir_is_light_member(attr)) {
        text_mem(spell->out, light.data, light.len);
        return;
    }
    text_char(&light, '.');
    text_mem(&light, spell->variables[attr].text, spell->variables[attr].len);
    spell_read(spell, &spell->shader->interface.variables.items[attr],
               (struct text_word){text_cstr(&light), light.len}, least);
}

/* Writes an op that has neither operands nor a form: a name. */
static void write_source(struct spell *spell, const struct ir_node *node,
                         enum lang_precedence least)
{
    switch (node->op) {
    case IR_UNIFORM:
    case IR_STREAM:
    case IR_TEXTURE: spell_name(spell, spell->variables[node->attr]); break;
    case IR_PARAM:
        text_char(spell->out, 'p');
        text_u32(spell->out, node->attr & 0xffff);
        break;
    case IR_LOCAL: spell_name(spell, spell->locals[node->attr]); break;
    case IR_CONTEXT: write_light(spell, node->attr, least); break;
    case IR_SAMPLE:
        spell_text(spell, node->attr == IR_SAMPLE_TURN ? spell->loop_turn.text : spell->loop_index);
        break;
    default: /* after an error, nobody uses the text */
        lang_print_value(spell->style, spell->shader->strings,
                         node->type < IR_NUM_TYPES ? node->type : IR_TYPE_FLOAT,
                         (const union ir_word[16]){{0}}, LANG_PREC_COMMA, spell->out);
    }
}

static void write_result(struct spell *spell, ir_ref call, uint32_t index,
                         enum lang_precedence least)
{
    uint32_t first = spell->local_of[call];
    assert(!first || first - 1 + index < spell->let_names.len);
    if (first)
        spell_name(spell, spell->let_names.items[first - 1 + index]);
    else
        spell_expression(spell, call, least);
}

/* A closure of the language, whose name may be a form: "f(a: $0, b: $1)". */
static void write_leaf(struct spell *spell, ir_ref ref, const struct ir_node *node,
                       enum lang_precedence least)
{
    const char *name = callee_name(spell, ref);
    if (strchr(name, '('))
        write_form(spell, node, lang_form_of(spell->scratch, name, LANG_PREC_POSTFIX), least);
    else
        write_call(spell, ref);
}

/* Writes a node without a local, for which the style has no form. */
static void write_other_node(struct spell *spell, ir_ref ref, const struct ir_node *node,
                             enum lang_precedence least)
{
    const struct ir_graph *graph = spell->shader->graph;
    switch (node->op) {
    case IR_CONST:
        lang_print_value(spell->style, spell->shader->strings, node->type,
                         graph->words.items + node->attr, least, spell->out);
        break;
    case IR_SWIZZLE: write_swizzle(spell, ref, node->attr); break;
    case IR_MEMBER: write_member(spell, ref, node->attr); break;
    case IR_CONSTRUCT: write_construct(spell, ref, node->type); break;
    case IR_CALL:
    case IR_VERBATIM:
    case IR_GRAPH_CALL: write_call(spell, ref); break;
    case IR_LEAF: write_leaf(spell, ref, node, least); break;
    case IR_RESULT: write_result(spell, ir_arg(graph, ref, 0), node->attr, least); break;
    case IR_CONTEXT: /* an operand numbers the loop or the light, whose text is the same */
    case IR_SAMPLE:
    case IR_LOCAL: write_source(spell, node, least); break;
    default:
        if (node->num_args == 0)
            write_source(spell, node, least);
        else
            write_form(spell, node, lang_style_form(spell->style, node->op), least);
    }
}

void spell_node(struct spell *spell, ir_ref ref, const struct ir_node *node,
                enum lang_precedence least)
{
    const struct lang_pieces *form = spell->style->forms[node->op];
    if (form && form->num)
        write_form(spell, node, form, least);
    else
        write_other_node(spell, ref, node, least);
}

/* The target's own form for these types; NULL: the syntax has the form. */
static const struct lang_pieces *typed_form(const struct spell *spell, ir_ref ref,
                                            const struct ir_node *node)
{
    bool has_form = ir_op_info(node->op)->flags & (OP_OPERATOR | OP_BUILTIN) || node->op == IR_CONST
                    || node->op > IR_LEAF;
    if (!has_form)
        return NULL;
    ir_type_id types[16];
    const union ir_word *constants[16];
    struct lang_use use = {.op = node->op,
                           .type = node->type,
                           .attr = node->attr,
                           .operands = types,
                           .constants = constants,
                           .node = ref};
    for (; use.num_operands < node->num_args && use.num_operands < 16; use.num_operands++) {
        ir_ref operand = ir_arg(spell->shader->graph, ref, use.num_operands);
        constants[use.num_operands] = ir_constant_words(spell->shader->graph, operand);
        types[use.num_operands] = ir_type_of(spell->shader->graph, operand);
        use.named |= (uint32_t)is_named(spell, operand) << use.num_operands;
    }
    return lang_typed_form(spell->style->syntax, &spell->lang_names, &use, spell->scratch);
}

void spell_typed_node(struct spell *spell, ir_ref ref, const struct ir_node *node,
                      enum lang_precedence least)
{
    const struct lang_pieces *own = typed_form(spell, ref, node);
    if (own)
        write_form(spell, node, own, least);
    else
        spell_node(spell, ref, node, least);
}
