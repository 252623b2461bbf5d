// SPDX-License-Identifier: Apache-2.0
/*
 * The members of a material and of its textures have the types that glTF gives them, or a message
 * says that they do not count.
 */
#include "import/import.h"

#include <string.h>

enum kind {
    NUMBER,
    NUMBERS, /* `most` of them */
    COUNT,   /* an integer from 0 to `most` */
    WORD,
    OBJECT,
};

struct member {
    const char *name;
    enum kind kind;
    unsigned most;
    const char *words[4];
};

/* Those beside the factors of program/gltf_inputs.h. */
static const struct member members[] = {
    {"alphaMode", WORD, 0, {"OPAQUE", "MASK", "BLEND"}},
    {"extensions", OBJECT, 0, {0}},
    {"index", COUNT, INT32_MAX, {0}},
    {"iridescenceThicknessMinimum", NUMBER, 0, {0}},
    {"offset", NUMBERS, 2, {0}},
    {"rotation", NUMBER, 0, {0}},
    {"strength", NUMBER, 0, {0}},
    {"texCoord", COUNT, IMPORT_MAX_TEXCOORD, {0}},
};

/* True for an extension, or what refers to a texture. */
static bool is_object(const char *name)
{
    for (size_t i = 0; i < gltf_num_inputs; ++i) {
        const struct gltf_input *row = &gltf_inputs[i];
        if ((row->texture && strcmp(row->texture, name) == 0)
            || (row->object && strcmp(row->object, name) == 0))
            return true;
    }
    return false;
}

/* A factor is a number, or an array of those that several rows have parts of; false: it is none. */
static bool find_factor(const char *name, struct member *out)
{
    bool is_found = false;
    *out = (struct member){name, NUMBER, 0, {0}};
    for (size_t i = 0; i < gltf_num_inputs; ++i) {
        const struct gltf_input *row = &gltf_inputs[i];
        if (!row->factor || strcmp(row->factor, name) != 0)
            continue;
        is_found = true;
        if (row->has_array && row->at + row->count > out->most)
            *out = (struct member){name, NUMBERS, row->at + row->count, {0}};
    }
    return is_found;
}

/* Finds the type that glTF gives a member; false: it has no meaning here. */
static bool find_member(const char *name, bool is_transform, struct member *out)
{
    for (size_t i = 0; i < sizeof members / sizeof *members; ++i)
        if (strcmp(members[i].name, name) == 0) {
            *out = members[i];
            return true;
        }
    if (find_factor(name, out))
        return true;
    bool is_scale = strcmp(name, "scale") == 0; /* of coordinates, or of a normal map */
    *out = (struct member){name, !is_scale ? OBJECT : is_transform ? NUMBERS : NUMBER, 2, {0}};
    return is_scale || is_object(name);
}

static bool fits(const struct member *member, const json_t *value)
{
    bool good = json_array_size(value) == member->most;
    switch (member->kind) {
    case NUMBER: return json_is_number(value);
    case OBJECT: return json_is_object(value);
    case COUNT:
        return json_is_integer(value) && json_integer_value(value) >= 0
               && json_integer_value(value) <= (json_int_t)member->most;
    case WORD:
        return json_is_string(value) && args_is_one_of(json_string_value(value), member->words);
    case NUMBERS: break;
    }
    for (size_t i = 0; i < member->most && good; ++i)
        good = json_is_number(json_array_get(value, i));
    return good;
}

static char *describe(const struct member *member)
{
    switch (member->kind) {
    case NUMBER: return cli_format("a number");
    case NUMBERS: return cli_format("an array of %u numbers", member->most);
    case COUNT: return cli_format("an integer from 0 to %u", member->most);
    case WORD:
        return cli_format("'%s', '%s' or '%s'", member->words[0], member->words[1],
                          member->words[2]);
    case OBJECT: break;
    }
    return cli_format("an object");
}

/* glTF nests material, extension, texture, extensions, transform. */
enum { MAX_DEPTH = 8 };

static void check(struct importing *importing, const char *of, const json_t *object,
                  bool is_transform, unsigned depth)
{
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)(uintptr_t)object, name, value)
    {
        struct member member;
        if (strcmp(name, "extras") == 0)
            continue;
        if (find_member(name, is_transform, &member) && !fits(&member, value)) {
            char *what = describe(&member);
            import_tell_loss(importing, of, "'%s' must be %s", name, what);
            free(what);
        }
        if (json_is_object(value) && depth < MAX_DEPTH)
            check(importing, of, value, strcmp(name, "KHR_texture_transform") == 0, depth + 1);
    }
}

void import_check_members(struct importing *importing, const char *of, const json_t *material)
{
    if (!json_is_object(material))
        import_tell_loss(importing, of, "a material is an object");
    check(importing, of, material, false, 0);
}
