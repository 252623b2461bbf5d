// SPDX-License-Identifier: Apache-2.0
/*
 * Constructors: GLSL 4.50, 5.4. The code adds their conversions and cuts as nodes, so that
 * CONSTRUCT only joins parts.
 */
#include "parse/parse_priv.h"

#include <assert.h>

static const uint8_t first_components[4] = {0, 1, 2, 3};

/* True for numbers, bools and their vectors: other scalars and vectors can be built from them. */
static bool is_part(ir_type_id type)
{
    ir_type_id scalar = ir_type_scalar(type);
    return scalar == IR_TYPE_BOOL || (check_rank(scalar) && !ir_type_is_matrix(type));
}

/* Converts to components of another scalar type; their number stays. */
static lang_ref with_scalar(struct parser *p, lang_ref a, ir_type_id scalar)
{
    ir_type_id type = ir_type_vector(scalar, ir_type_components(tree_type(p, a)));
    return type == IR_TYPE_VOID ? 0 : check_cast(p, a, type);
}

static lang_ref cut(struct parser *p, lang_ref a, unsigned components, uint32_t place)
{
    return ir_type_components(tree_type(p, a)) > components
               ? tree_swizzle(p, a, first_components, components, place)
               : a;
}

static lang_ref wrong_parts(struct parser *p, ir_type_id type, uint32_t place, const char *why)
{
    PARSE_TYPE_ERROR(p, place, "%s cannot be built from this: %s", parse_type_text(p, type), why);
    return 0;
}

static lang_ref construct_from_one(struct parser *p, ir_type_id type, lang_ref a, uint32_t place)
{
    ir_type_id from = tree_type(p, a), scalar = ir_type_scalar(type);
    unsigned have = ir_type_components(from), want = ir_type_components(type);
    if (ir_type_is_matrix(type) && ir_type_is_matrix(from) && have >= want)
        return check_cast(p, a, type);
    if (!is_part(from))
        return wrong_parts(p, type, place,
                           parse_say(p, "%s does not convert", parse_type_text(p, from)));
    bool splats = have == 1 && want > 1; /* fills a vector, or the diagonal of a matrix */
    if ((have < want || ir_type_is_matrix(type)) && !splats)
        return wrong_parts(
            p, type, place,
            parse_say(p, "%s has %u of %u components", parse_type_text(p, from), have, want));
    a = cut(p, a, want, place);
    a = a ? with_scalar(p, a, scalar) : 0;
    if (!a)
        return p->panic
                   ? 0
                   : wrong_parts(p, type, place,
                                 parse_say(p, "%s does not convert", parse_type_text(p, from)));
    assert(splats || ir_type_components(tree_type(p, a)) == want);
    return splats ? tree_op(p, IR_CONSTRUCT, type, 0, &a, 1, place) : a;
}

static lang_ref construct_from_parts(struct parser *p, ir_type_id type, lang_ref *args,
                                     unsigned num_args, uint32_t place)
{
    unsigned have = 0, want = ir_type_components(type);
    for (unsigned i = 0; i < num_args; i++) {
        ir_type_id from = tree_type(p, args[i]);
        if (!is_part(from))
            return wrong_parts(
                p, type, tree_place(p, args[i]),
                parse_say(p, "%s is neither scalar nor vector", parse_type_text(p, from)));
        if (have >= want)
            return wrong_parts(p, type, tree_place(p, args[i]),
                               "the arguments before this one fill it");
        unsigned rest = want - have;
        have += ir_type_components(from);
        args[i] = cut(p, args[i], rest, place);
        args[i] = args[i] ? with_scalar(p, args[i], ir_type_scalar(type)) : 0;
        if (!args[i])
            return p->panic
                       ? 0
                       : wrong_parts(p, type, place,
                                     parse_say(p, "%s does not convert", parse_type_text(p, from)));
    }
    if (have < want || (ir_type_is_matrix(type) && have > want))
        return wrong_parts(p, type, place,
                           parse_say(p, "it needs %u components; these are %u", want, have));
    return tree_op(p, IR_CONSTRUCT, type, 0, args, num_args, place);
}

static lang_ref construct_array(struct parser *p, ir_type_id type, ir_type_id element,
                                uint32_t length, lang_ref *args, unsigned num_args, uint32_t place)
{
    if (num_args != length)
        return wrong_parts(p, type, place, parse_say(p, "these are %u elements", num_args));
    for (unsigned i = 0; i < num_args; i++) {
        args[i] = check_convert(p, args[i], element, "an element");
        if (!args[i])
            return 0;
    }
    return tree_op(p, IR_CONSTRUCT, type, 0, args, num_args, place);
}

static lang_ref construct_struct(struct parser *p, ir_type_id type, lang_ref *args,
                                 unsigned num_args, uint32_t place)
{
    const struct lang_unit *layer;
    const struct ir_user_type *user = lang_user_type(p->unit, type, &layer);
    assert(user->array_length == 0);
    if (num_args != user->num_members)
        return wrong_parts(
            p, type, place,
            parse_say(p, "it has %u members; these are %u", user->num_members, num_args));
    for (unsigned i = 0; i < num_args; i++) {
        struct ir_member member = layer->members.items[user->first_member + i];
        args[i] = check_convert(p, args[i], member.type,
                                parse_say(p, "member '%s'", parse_text(p, member.name)));
        if (!args[i])
            return 0;
    }
    return tree_op(p, IR_CONSTRUCT, type, 0, args, num_args, place);
}

lang_ref check_construct(struct parser *p, ir_type_id type, lang_ref *args, unsigned num_args,
                         uint32_t place)
{
    ir_type_id element;
    uint32_t length;
    if (num_args == 0)
        return wrong_parts(p, type, place, "there are no arguments");
    if (check_is_array(p, type, &element, &length))
        return construct_array(p, type, element, length, args, num_args, place);
    if (type >= IR_TYPE_FIRST_USER)
        return construct_struct(p, type, args, num_args, place);
    if (!is_part(type) && !ir_type_is_matrix(type))
        return wrong_parts(p, type, place, "it has no constructor");
    if (num_args == 1)
        return construct_from_one(p, type, args[0], place);
    return construct_from_parts(p, type, args, num_args, place);
}
