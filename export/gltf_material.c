// SPDX-License-Identifier: Apache-2.0
/* A material: members for inputs that differ from glTF's defaults and do something. */
#include "export/gltf.h"

#include "program/memory.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_INPUTS = 32, OPAQUE_MODE = 0, MASK_MODE = 1 };

/* An input of the table in a material. */
struct cell {
    const struct gltf_input *row;
    const struct flat_input *input; /* NULL: the material does not set it */
    bool is_textured;
    bool is_plain;   /* a texture of one value: the format has no factor */
    float factor[4]; /* of the texture, or alone */
    float range;     /* the number that is 1 in the texture */
};

struct state {
    struct gltf *gltf;
    const struct flat_material *material;
    struct cell cells[MAX_INPUTS];
    int alpha_mode; /* 0 opaque, 1 mask, 2 blend */
    json_t *json;
};

static struct cell *find(struct state *state, const char *name)
{
    return &state->cells[gltf_find_input(name) - gltf_inputs];
}

static float value_of(const struct state *state, const char *name, float otherwise)
{
    const struct flat_input *input = flat_find(state->material, name);
    return input && input->num_values ? input->values[0] : otherwise;
}

/* ---- Values ---- */

static float clamped(const struct gltf_input *row, float value)
{
    bool is_zero = row->or_zero && value == 0;
    return is_zero ? value : fmaxf(fminf(value, row->high), row->low);
}

/* Tells that numbers from `low` to `high` become those of the range. */
static void tell_clamped(const struct state *state, const struct gltf_input *row, float low,
                         float high)
{
    const float slack = 1e-3f; /* of values that are rounded */
    if (fabsf(clamped(row, low) - low) <= slack && fabsf(clamped(row, high) - high) <= slack)
        return;
    const struct flat *flat = state->gltf->flat;
    char *place = flat_input_place(flat, state->material, row->name);
    report_warning(flat->report, "export-clamped",
                   "'%s/%s' (%s) has values from %g to %g; glTF keeps %sthose from %g to %s",
                   state->material->name, row->name, place, (double)low, (double)high,
                   row->or_zero ? "0 and " : "", (double)row->low,
                   isinf(row->high) ? "infinity" : "1");
    free(place);
}

static bool is_angle(const struct cell *cell)
{
    return strcmp(cell->row->name, "anisotropy_rotation") == 0;
}

/* The range of a texture, which is its factor. */
static bool read_texture(const struct state *state, struct cell *cell)
{
    float low = 0, high = 1;
    bool is_number = cell->row->factor && !is_angle(cell);
    if (is_number
        && !texture_find_range(state->gltf->flat->report, &cell->input->image, &low, &high))
        return false;
    tell_clamped(state, cell->row, low, high);
    cell->range = fmaxf(clamped(cell->row, high), 1);
    for (unsigned i = 0; i < 4; ++i)
        cell->factor[i] = is_angle(cell) ? 0 : cell->range;
    return true;
}

static void read_value(const struct state *state, struct cell *cell)
{
    float low = INFINITY, high = -INFINITY;
    for (unsigned i = 0; i < cell->row->count; ++i) {
        float value = cell->input ? cell->input->values[i] : cell->row->value;
        low = fminf(low, value);
        high = fmaxf(high, value);
        cell->factor[i] = clamped(cell->row, value);
    }
    tell_clamped(state, cell->row, low, high);
    cell->is_plain =
        !cell->row->factor && cell->row->count == 1 && cell->factor[0] != cell->row->omitted;
    cell->is_textured = cell->is_plain;
}

static bool read_cells(struct state *state)
{
    bool good = true;
    for (size_t i = 0; good && i < gltf_num_inputs; ++i) {
        struct cell *cell = &state->cells[i];
        *cell = (struct cell){.row = &gltf_inputs[i],
                              .input = flat_find(state->material, gltf_inputs[i].name),
                              .range = 1};
        bool is_image = cell->input && cell->input->image.path;
        cell->is_textured = is_image && cell->row->texture;
        if (is_image && !cell->is_textured) {
            flat_tell_loss(state->gltf->flat, state->material, cell->row->name,
                           "glTF has one value for it, and no texture");
            cell->input = NULL;
        }
        if (cell->is_textured)
            good = read_texture(state, cell);
        else
            read_value(state, cell);
    }
    return good;
}

/* Emission above 1 is a part of its strength. */
static void move_strength(struct state *state)
{
    struct cell *color = find(state, "emissive"), *strength = find(state, "emissive_strength");
    float most = fmaxf(color->factor[0], fmaxf(color->factor[1], color->factor[2]));
    if (most <= 1)
        return;
    for (unsigned i = 0; i < 3; ++i)
        color->factor[i] /= most;
    strength->factor[0] = fminf(strength->factor[0] * most, FLT_MAX);
}

static bool is_zero(struct state *state, const char *name)
{
    const struct cell *cell = find(state, name);
    bool is_zero = !cell->is_textured;
    for (unsigned i = 0; i < cell->row->count; ++i)
        is_zero = is_zero && cell->factor[i] == 0;
    return is_zero;
}

/* ---- KHR_materials_unlit ---- */

static bool only_emits(struct state *state)
{
    static const char *const others[] = {"base_color",  "metallic",  "specular",
                                         "sheen_color", "clearcoat", "transmission"};
    bool others_are_zero = true;
    for (size_t i = 0; i < sizeof others / sizeof *others; ++i)
        others_are_zero = others_are_zero && is_zero(state, others[i]);
    return others_are_zero && !is_zero(state, "emissive")
           && find(state, "emissive_strength")->factor[0] == 1;
}

/* The emission is the base colour; what extensions have says nothing any more. */
static void make_unlit(struct state *state)
{
    const char *extension = "KHR_materials_unlit";
    struct cell *base = find(state, "base_color"), *emissive = find(state, "emissive");
    const struct gltf_input *row = base->row;
    *base = *emissive;
    base->row = row;
    for (size_t i = 0; i < gltf_num_inputs; ++i) {
        struct cell *cell = &state->cells[i];
        bool is_extension = cell->row->object && strncmp(cell->row->object, "KHR_", 4) == 0;
        if (!is_extension && cell != emissive)
            continue;
        *cell = (struct cell){.row = cell->row};
        for (unsigned k = 0; k < cell->row->count; ++k)
            cell->factor[k] = cell->row->omitted;
    }
    gltf_add(gltf_array(state->gltf->root, "extensionsUsed"), json_string(extension));
    gltf_object(gltf_object(state->json, "extensions"), extension);
}

static bool does_something(struct state *state, const struct cell *cell)
{
    for (size_t i = 0; i < 2 && cell->row->needs[i]; ++i)
        if (is_zero(state, cell->row->needs[i]))
            return false;
    return strcmp(cell->row->name, "alpha") == 0          ? state->alpha_mode != OPAQUE_MODE
           : strcmp(cell->row->name, "alpha_cutoff") == 0 ? state->alpha_mode == MASK_MODE
                                                          : true;
}

/* ---- Textures ---- */

/* True if the cell is a part of the image. */
static bool is_part(struct state *state, const struct cell *cell, enum gltf_image image)
{
    return cell->is_textured && cell->row->image == image && does_something(state, cell);
}

/* The place of all parts of an image. NULL: they have several, or none has one of its own. */
static const struct flat_image *find_place(struct state *state, enum gltf_image image,
                                           bool *out_several)
{
    const struct flat_image *first = NULL;
    for (size_t i = 0; i < gltf_num_inputs; ++i) {
        const struct cell *cell = &state->cells[i];
        if (!is_part(state, cell, image) || cell->is_plain)
            continue;
        const struct flat_image *other = &cell->input->image;
        first = first ? first : other;
        *out_several = *out_several || memcmp(first->scale, other->scale, sizeof first->scale) != 0
                       || memcmp(first->offset, other->offset, sizeof first->offset) != 0;
    }
    return !first || *out_several || flat_is_unplaced(first) ? NULL : first;
}

static struct texture make_texture(struct state *state, enum gltf_image image)
{
    const float neutral[4] = {1, image == GLTF_ANISOTROPY ? 0.5f : 1, 1, 1};
    struct texture texture = {.is_srgb = gltf_images[image].is_srgb};
    size_t num = 0;
    find_place(state, image, &texture.is_placed);
    for (size_t c = 0; c < 4; ++c)
        texture.channels[c] = (struct texture_channel){.value = neutral[c], .range = 1};
    for (size_t i = 0; i < gltf_num_inputs; ++i) {
        const struct cell *cell = &state->cells[i];
        if (!is_part(state, cell, image))
            continue;
        unsigned first = cell->row->channel, count = is_angle(cell) ? 2 : cell->row->count;
        for (unsigned c = 0; c < count; ++c)
            texture.channels[first + c] =
                (struct texture_channel){.image = cell->is_plain ? NULL : &cell->input->image,
                                         .component = is_angle(cell) ? 0 : c,
                                         .part = !is_angle(cell) ? TEXTURE_VALUE
                                                 : c             ? TEXTURE_SINE
                                                                 : TEXTURE_COSINE,
                                         .value = cell->factor[0],
                                         .range = cell->range};
        texture.has_alpha |= first + count > 3;
        texture.is_whole = !num && !first && !cell->is_plain && !is_angle(cell) && cell->range == 1
                           && cell->input->image.components == count;
        ++num;
    }
    texture.is_whole = texture.is_whole && num == 1;
    return texture;
}

/* The wrapping of the first image; a texture has one for all of its channels. */
static json_t *make_sampler(struct state *state, enum gltf_image image)
{
    static const int wraps[] = {[FLAT_REPEAT] = 10497, [FLAT_CLAMP] = 33071, [FLAT_MIRROR] = 33648};
    static const char *const members[] = {"wrapS", "wrapT"};
    enum { CLOSEST = 9728 };
    const struct flat_image *first = NULL;
    json_t *sampler = json_object();
    bool is_placed = false;
    find_place(state, image, &is_placed);
    for (size_t i = 0; !is_placed && i < gltf_num_inputs; ++i) {
        const struct cell *cell = &state->cells[i];
        const struct flat_image *other = cell->input ? &cell->input->image : NULL;
        if (!is_part(state, cell, image) || cell->is_plain)
            continue;
        first = first ? first : other;
        if (memcmp(first->wrap, other->wrap, sizeof first->wrap) != 0)
            flat_tell_loss(state->gltf->flat, state->material, cell->row->name,
                           "its image repeats in another way than the one that shares its texture");
    }
    for (size_t i = 0; first && i < 2; ++i)
        if (first->wrap[i] != FLAT_REPEAT)
            json_set(sampler, members[i], json_integer(wraps[first->wrap[i]]));
    if (first && first->is_closest) {
        json_set(sampler, "magFilter", json_integer(CLOSEST));
        json_set(sampler, "minFilter", json_integer(CLOSEST));
    }
    return sampler;
}

/* Makes the file of a texture once. Returns its index; SIZE_MAX after reporting an error. */
static size_t add_file(struct state *state, enum gltf_image image)
{
    struct gltf *gltf = state->gltf;
    const struct texture texture = make_texture(state, image);
    struct gltf_texture_file file = {.key = texture_key(&texture)};
    for (size_t i = 0; i < gltf->num_files; ++i)
        if (strcmp(gltf->files[i].key, file.key) == 0) {
            free(file.key);
            return i;
        }
    if (!texture_make(gltf->flat->report, &texture, &file.file)) {
        free(file.key);
        return SIZE_MAX;
    }
    file.name = cli_format("%s_%s", state->material->name, gltf_images[image].name);
    MEMORY_PUSH(gltf->files, gltf->num_files, file);
    return gltf->num_files - 1;
}

/* The index of a texture with the image. false after reporting an error. */
static bool add_texture(struct state *state, enum gltf_image image, size_t *out)
{
    json_t *root = state->gltf->root, *texture, *sampler;
    size_t file = add_file(state, image);
    if (file == SIZE_MAX)
        return false;
    sampler = make_sampler(state, image);
    texture = json_object();
    json_set(texture, "source", json_integer((json_int_t)file));
    if (json_object_size(sampler))
        json_set(texture, "sampler",
                 json_integer((json_int_t)gltf_add(gltf_array(root, "samplers"), sampler)));
    else
        json_decref(sampler);
    *out = gltf_add(gltf_array(root, "textures"), texture);
    return true;
}

/* ---- Members ---- */

/* The object with the member of a row. */
static json_t *place_of(struct state *state, const struct gltf_input *row)
{
    if (!row->object)
        return state->json;
    if (strncmp(row->object, "KHR_", 4) != 0)
        return gltf_object(state->json, row->object);
    gltf_add(gltf_array(state->gltf->root, "extensionsUsed"), json_string(row->object));
    return gltf_object(gltf_object(state->json, "extensions"), row->object);
}

/* With as few digits as tell it: 0.1, not 0.100000001. */
static json_t *number(float value)
{
    char text[32];
    snprintf(text, sizeof text, "%.7g", (double)value);
    return json_real(strtod(text, NULL));
}

/* An array of a factor, as glTF has it without the member. */
static json_t *factor_array(struct state *state, const struct gltf_input *row)
{
    json_t *object = place_of(state, row), *array = json_object_get(object, row->factor);
    if (array)
        return array;
    array = json_array();
    json_set(object, row->factor, array);
    for (size_t i = 0; i < gltf_num_inputs; ++i)
        if (gltf_inputs[i].factor && strcmp(gltf_inputs[i].factor, row->factor) == 0)
            for (unsigned k = 0; k < gltf_inputs[i].count; ++k)
                json_array_append_new(array, number(gltf_inputs[i].omitted));
    return array;
}

static void add_factor(struct state *state, const struct cell *cell)
{
    const struct gltf_input *row = cell->row;
    bool differs = false;
    for (unsigned i = 0; i < row->count; ++i)
        differs = differs || cell->factor[i] != row->omitted;
    if (!differs || !row->factor)
        return;
    for (unsigned i = 0; row->has_array && i < row->count; ++i)
        json_array_set_new(factor_array(state, row), row->at + i, number(cell->factor[i]));
    if (!row->has_array)
        json_set(place_of(state, row), row->factor, number(cell->factor[0]));
}

/* KHR_texture_transform, which counts v downwards. */
static void add_transform(struct state *state, enum gltf_image image, json_t *info)
{
    static const char *const extension = "KHR_texture_transform";
    bool are_several = false;
    const struct flat_image *place = find_place(state, image, &are_several);
    if (!place)
        return;
    json_t *transform = gltf_object(gltf_object(info, "extensions"), extension);
    const double *scale = place->scale,
                 offset[] = {place->offset[0], 1 - scale[1] - place->offset[1]};
    gltf_add(gltf_array(state->gltf->root, "extensionsUsed"), json_string(extension));
    if (offset[0] != 0 || offset[1] != 0)
        json_set(transform, "offset",
                 json_pack("[o, o]", number((float)offset[0]), number((float)offset[1])));
    if (scale[0] != 1 || scale[1] != 1)
        json_set(transform, "scale",
                 json_pack("[o, o]", number((float)scale[0]), number((float)scale[1])));
}

static bool add_texture_info(struct state *state, const struct cell *cell)
{
    size_t index = 0;
    if (!cell->is_textured)
        return true;
    if (!add_texture(state, cell->row->image, &index))
        return false;
    json_t *info = gltf_object(place_of(state, cell->row), cell->row->texture);
    json_set(info, "index", json_integer((json_int_t)index));
    if (cell->input && cell->input->scale != 1)
        json_set(info, "scale", json_real(cell->input->scale));
    add_transform(state, cell->row->image, info);
    return true;
}

static void tell_others(struct state *state)
{
    for (size_t i = 0; i < state->material->num_inputs; ++i) {
        const char *name = state->material->inputs[i].name;
        bool is_known = strcmp(name, "alpha_mode") == 0;
        for (size_t k = 0; k < gltf_num_inputs; ++k)
            is_known = is_known || strcmp(gltf_inputs[k].name, name) == 0;
        if (!is_known)
            flat_tell_loss(state->gltf->flat, state->material, name, "glTF has nothing like it");
    }
}

bool gltf_add_material(struct gltf *gltf, const struct flat_material *material, bool *out_tangents)
{
    struct state state = {.gltf = gltf, .material = material, .json = json_object()};
    bool good = true;
    json_array_append_new(gltf_array(gltf->root, "materials"), state.json);
    json_set_text(state.json, "name", material->name);
    state.alpha_mode = (int)value_of(&state, "alpha_mode", OPAQUE_MODE);
    if (!read_cells(&state))
        return false;
    move_strength(&state);
    if (only_emits(&state))
        make_unlit(&state);
    tell_others(&state);
    for (size_t i = 0; good && i < gltf_num_inputs; ++i) {
        const struct cell *cell = &state.cells[i];
        if (!does_something(&state, cell))
            continue;
        add_factor(&state, cell);
        good = add_texture_info(&state, cell);
        if (strcmp(cell->row->name, "iridescence_thickness") == 0 && cell->is_textured)
            json_set(place_of(&state, cell->row), "iridescenceThicknessMinimum", json_integer(0));
        *out_tangents =
            *out_tangents
            || (cell->is_textured && !cell->row->factor && !cell->is_plain && cell->row->count == 3)
            || cell->row->image == GLTF_ANISOTROPY;
    }
    if (state.alpha_mode != OPAQUE_MODE)
        json_set_text(state.json, "alphaMode", state.alpha_mode == MASK_MODE ? "MASK" : "BLEND");
    /* Both sides of a surface are the material, unless it bounds a volume. */
    if (is_zero(&state, "thickness"))
        json_set(state.json, "doubleSided", json_true());
    return good;
}
