// SPDX-License-Identifier: Apache-2.0
#include "api/generation.h"
#include "api/scene.h"

#include <assert.h>

/* Options and targets have no place in a file. */
static const struct diag_place nowhere = {0};

/* ---- Start: target, element, options ---- */

static bool find_target(struct generation *g)
{
    const mxg_context *context = g->result->object.context;
    g->result->target = context_target(context, g->desc.target);
    if (g->result->target)
        return true;
    struct text known;
    text_init(&known, &g->scratch);
    for (const struct target *const *target = targets; *target; target++)
        text_fmt(&known, "%s%s", target == targets ? "" : ", ", (*target)->name);
    for (uint32_t i = 0; i < context->num_dialects; i++)
        text_fmt(&known, ", %s", context->dialects[i].target.name);
    diag_add(diags_of(g), DIAG_ID_unknown_target, nowhere, g->desc.target, text_cstr(&known));
    return false;
}

/* The version from the options; NULL for the target's default version. */
static const char *version_of(const struct generation *g)
{
    const char *version = g->options[OPTION_version].text;
    return *version ? version : NULL;
}

static bool check_version(struct generation *g)
{
    const char *version = version_of(g);
    const char *const *known = g->result->target->versions;
    struct text list;
    text_init(&list, &g->scratch);
    for (; version && known && *known; known++) {
        if (strcmp(*known, version) == 0)
            return true;
        text_fmt(&list, "%s%s", list.len ? ", " : "", *known);
    }
    if (version)
        diag_add(diags_of(g), DIAG_ID_bad_option, nowhere, version, option_key(OPTION_version),
                 list.len ? text_cstr(&list) : "no version");
    return !version;
}

static str_id option_name(struct generation *g, enum option_id option)
{
    return str_intern_z(&g->result->strings, g->options[option].text);
}

static void set_build_options(struct generation *g)
{
    const struct option_value *o = g->options;
    const mxg_context *context = g->result->object.context;
    uint64_t caps = target_capabilities(g->result->target);
    bool hosts_environment = o[OPTION_host_environment].number && o[OPTION_environment].number != 0;
    g->build_options = (struct build_options){
        .syntax = g->result->target->syntax,
        .interface = role_is_pass(g->role) ? INTERFACE_REDUCED
                                           : (enum build_interface)o[OPTION_interface].number,
        .publish_all = o[OPTION_publish].number != 0,
        .uniform_globs = o[OPTION_uniform].list.items,
        .num_uniform_globs = role_is_pass(g->role) ? 0 : o[OPTION_uniform].list.len,
        .constant_globs = o[OPTION_constant].list.items,
        .num_constant_globs = o[OPTION_constant].list.len,
        .colorspace = option_name(g, OPTION_colorspace),
        .distance_unit = option_name(g, OPTION_distance_unit),
        .angle_unit = str_intern_z(&g->result->strings, "degree"),
        .caps = caps,
        .neutral_names = o[OPTION_names].number != 0,
        .environment = hosts_environment ? 1 : o[OPTION_environment].number,
        .host_environment = hosts_environment,
        .albedo = o[OPTION_albedo].number,
        .quality = o[OPTION_quality].number,
        .texture_origin = o[OPTION_texture_origin].number,
        .texture_modes =
            caps & CAP_SAMPLERS ? o[OPTION_texture_modes].number : TEXTURE_MODES_BUT_BORDERS,
        .tiles = o[OPTION_tiles].number == 0 && caps & CAP_TEXTURE_ARRAYS,
        .reader = &g->reader,
        .list_folder = context->resolver.list_folder,
        .list_user_data = context->resolver.user_data,
        .texture_fault = stdio_texture_fault,
        .texture_user_data = g->result->object.context,
        .read_texels = context->texels.read_texels,
        .texels_user_data = context->texels.user_data,
        .keeps_absent = o[OPTION_layering].number == LAYERING_OCCLUDING,
        .sss = o[OPTION_sss].number,
        .blurs = o[OPTION_rough_refraction].number != 0,
        .mattes = o[OPTION_mattes].number != 0,
        .occlusion = (enum build_occlusion)o[OPTION_ambient_occlusion].number,
        .asks_thickness = o[OPTION_host_thickness].number != 0,
        .codes = context->codes,
        .num_codes = context->num_codes,
        .cancel = context->cancel,
        .cancel_user_data = context->cancel_user_data,
    };
    generation_name_targets(g);
    g->result->colorspace = g->build_options.colorspace;
}

/* The result's own library layers, because generation does not write to the document. */
static void init_layers(struct generation *g)
{
    mxg_result *result = g->result;
    assert(result->strings.num == 0 && result->graph.nodes.len == 0);
    struct arena *arena = &result->object.arena;
    const struct library *layer = &g->document->layer;
    strpool_init(&result->strings, arena, &layer->strings);
    lang_unit_init(&result->unit, arena, &result->strings, &layer->unit);
    ir_graph_init(&result->graph, arena, &result->strings);
    result->graph.max_nodes = result->object.context->max_nodes;
    result->graph.has_no_neighbours = g->role->derivatives == DERIVATIVES_NONE;
    shader_init(&result->shader, g->role, arena, &result->strings, &result->graph, &result->unit);
    if (g->options[OPTION_host_lights].number && g->role->lights == LIGHTS_IN_SHADER)
        result->shader.lights = LIGHTS_OF_HOST;
}

/*
 * The document type of the generated element; 0 if the node has several outputs, because then the
 * type of the definition does not apply.
 */
static str_id value_type(const struct generation *g)
{
    return doc_attr_value(&g->document->layer.doc, g->element, STR_type);
}

static void name_element(struct generation *g)
{
    const struct document *doc = &g->document->layer.doc;
    const struct element *element = doc_element(doc, g->element);
    struct shader *shader = &g->result->shader;
    struct text path;
    text_init(&path, &g->scratch);
    doc_path(doc, g->element, '/', &path);
    if (g->output_name)
        text_fmt(&path, "/%s", str_text(doc->strings, g->output_name));
    shader->reflection.name = element->name;
    shader->reflection.element_type = element->category;
    shader->reflection.path = str_intern(shader->strings, path.data, path.len);
    shader->reflection.value_type = value_type(g);
}

/* The surface of a lighting pass has the name of the pass. */
static void name_pass(struct generation *g)
{
    struct shader *shader = &g->result->shader;
    shader->reflection.name = str_intern_z(shader->strings, deferred_pass_name(g->result->pass));
    shader->reflection.element_type = str_intern_z(shader->strings, "pass");
    shader->reflection.path = 0;
}

static void name_stack(struct generation *g)
{
    struct shader *shader = &g->result->shader;
    char name[BIND_STACK_NAME_SIZE];
    bind_stack_name(&g->desc.bindings->bindings, g->desc.stack, name);
    shader->reflection.name = shader->reflection.path = str_intern_z(shader->strings, name);
    shader->reflection.element_type = str_intern_z(shader->strings, "stack");
}

/* The functions of the libraries are those below the document's. */
static void import_module(struct generation *g)
{
    const char *name = g->options[OPTION_mdl_module].text;
    if (*name)
        shader_import_module(&g->result->shader, name, g->document->layer.unit.base_functions);
}

static void name_shader(struct generation *g)
{
    struct shader *shader = &g->result->shader;
    if (g->desc.bindings)
        name_stack(g);
    else
        name_element(g);
    if (role_is_pass(g->role))
        name_pass(g);
    shader->style = arena_alloc(shader->arena, sizeof *shader->style);
    lang_style_init(shader->style, g->result->target->syntax, shader->arena);
    for (const struct target *t = g->result->target; t && !shader->sources.language; t = t->base)
        shader->sources.language = t->source;
    shader->interface.max_lights = (uint32_t)g->options[OPTION_max_lights].number;
    shader->picks = g->options[OPTION_slots].number != 0;
    shader->interface.reserved = g->options[OPTION_reserved].list.items;
    shader->interface.num_reserved = g->options[OPTION_reserved].list.len;
}

/* The place of messages about a stack: its base, or the look. */
static elem_id element_of_stack(const struct generation *g)
{
    const struct bindings *b = &g->desc.bindings->bindings;
    const struct bind_state *state = &b->states.items[b->stacks.items[g->desc.stack].state];
    if (state->num_items)
        return b->look.assigns.items[b->items.items[state->first_item].assign].target;
    return b->look.element ? b->look.element : g->document->layer.doc.root;
}

/*
 * Names of vertex data and results have no prefix, because they are members or parameters. The
 * fixed texts of passes have names of their own.
 */
static void name_variables(struct generation *g)
{
    struct shader *shader = &g->result->shader;
    if (role_is_pass(g->role))
        return;
    const char *prefix = g->options[OPTION_prefix].text;
    shader->interface.naming.prefix = arena_strndup(shader->arena, prefix, strlen(prefix));
    naming_pairs(&g->options[OPTION_rename], shader->arena, &shader->interface.naming);
    shader->interface.naming_of_members = shader->interface.naming;
    shader->interface.naming_of_members.prefix = "";
    if (g->role->stages == STAGES_NONE)
        shader->reflection.function = names_of_frame(shader, g->role->entry);
    if (g->role->is_in_host_file)
        shader->reflection.function_type = names_of_frame(shader, SHADER_FUNCTION_RESULT);
}

bool generation_start(struct generation *g)
{
    bool good = find_target(g);
    if (good) {
        g->options = options_for(g->result->target, g->desc.options, &g->result->object.arena,
                                 context_dialect(g->result->object.context, g->result->target));
        bool fits = generation_find_role(g), has_names = generation_check_names(g);
        good = check_version(g) && fits && has_names;
    }
    g->element = g->desc.bindings ? element_of_stack(g)
                                  : document_find_element(g->document, g->desc.element, diags_of(g),
                                                          &g->output_name, &g->output);
    if (!good || !g->element)
        return false;
    g->result->options = options_hash(g->options);
    generation_check_globs(g);
    init_layers(g);
    name_shader(g);
    import_module(g);
    name_variables(g);
    set_build_options(g);
    generation_slab_features(g);
    return true;
}

/* ---- Build ---- */

static bool is_cancelled(struct generation *g)
{
    const mxg_context *context = g->result->object.context;
    g->cancelled = g->cancelled || (g->builder && build_cancelled(g->builder))
                   || (context->cancel && context->cancel(context->cancel_user_data));
    return g->cancelled;
}

void generation_report_not_renderable(struct generation *g, const char *why)
{
    const struct document *doc = &g->document->layer.doc;
    struct text unknown;
    text_init(&unknown, &g->scratch);
    if (g->lacks) {
        text_fmt(&unknown, "%s has %s", g->result->target->name, g->lacks);
        why = text_cstr(&unknown);
    }
    diag_add(diags_of(g), DIAG_ID_not_renderable, doc_place(doc, g->element),
             doc_name(doc, g->element), why);
}

static const char gives_nothing[] = "it is not a surface, volume, light or colour";

/* True if work may go on: not cancelled, within limits, no error. */
static bool is_good(struct generation *g)
{
    if (is_cancelled(g))
        return false;
    if (g->result->graph.overflow)
        diag_add(diags_of(g), DIAG_ID_node_limit, doc_place(&g->document->layer.doc, g->element),
                 (unsigned)g->result->graph.max_nodes);
    return diags_of(g)->num_errors == 0;
}

bool generation_build(struct generation *g)
{
    g->builder =
        build_start(&g->document->layer, &g->build_options, &g->result->shader, diags_of(g));
    build_know_slabs(g->builder);
    if (g->options[OPTION_aovs].list.len)
        build_list_aovs(g->builder, g->options[OPTION_aovs].list.items,
                        g->options[OPTION_aovs].list.len);
    if (g->options[OPTION_network].number)
        build_record_network(g->builder, &g->result->network, g->result->target->network->end_layer,
                             g->result->target->network->fits_family);
    g->root = g->desc.bindings ? build_stack(g->builder, &g->desc.bindings->bindings, g->desc.stack)
                               : build_element(g->builder, g->element, g->output);
    assert(g->root < g->result->graph.nodes.len);
    ir_assert_valid(&g->result->graph, "after build");
    if (!is_good(g))
        return false;
    if (!g->root) {
        generation_report_not_renderable(g, gives_nothing);
        return false;
    }
    return generation_is_defined(g, &g->result->graph, &g->root, 1, g->element);
}

/* ---- Emit ---- */

void generation_walk_slabs(struct generation *g)
{
    g->root = build_walk_slabs(g->builder, &g->closure_host, g->root);
    ir_assert_valid(&g->result->graph, "after the walk of slabs");
}

/* The lights of a host are there unless the option `lights` is set, to `none`. */
static bool has_lights(const struct generation *g)
{
    const struct shader *shader = &g->result->shader;
    if (shader->lights == LIGHTS_OF_HOST)
        return !g->options[OPTION_lights].is_set;
    return shader->interface.lights.len > 0 && shader->interface.max_lights > 0;
}

static enum closure_darkening darkening_of(const struct generation *g, enum option_id map,
                                           enum option_id function)
{
    return g->options[function].number ? DARKENED_BY_HOST
           : g->options[map].number    ? DARKENED_BY_MAP
                                       : DARKENED_BY_NOTHING;
}

/* A pass has no texture coordinates for the map: the material pass read it; a payload has none. */
static enum closure_darkening occlusion_of(const struct generation *g)
{
    enum closure_darkening by = darkening_of(g, OPTION_occlusion_map, OPTION_host_occlusion);
    bool reads_map = by != DARKENED_BY_MAP || g->role->reads == READS_DOCUMENT;
    return reads_map                        ? by
           : g->role->reads == READS_PIXELS ? DARKENED_AS_STORED
                                            : DARKENED_BY_NOTHING;
}

void generation_start_closures(struct generation *g)
{
    const struct option_value *lights = &g->options[OPTION_lights];
    if (g->result->shader.lights == LIGHTS_IN_SHADER)
        build_lights(g->builder, lights->list.items, lights->list.len, lights->is_set);
    g->closure_host = build_closure_host(g->builder, &g->point);
    g->closure_host.scratch = &g->estimates;
    if (g->result->target->closures && g->result->target->closures->lacks_view)
        g->point.view = closure_normal(&g->result->shader, &g->closure_host);
    g->lighting = (struct closure_lighting){
        .lights = has_lights(g),
        .environment = g->options[OPTION_environment].number != 0,
        .two_sided = g->options[OPTION_layering].number == LAYERING_TWO_SIDED,
        .transmits_alpha = g->options[OPTION_transmission].number != 0,
        .transparency = (uint8_t)g->options[OPTION_transparency].number,
        .shadow = darkening_of(g, OPTION_shadow_map, OPTION_host_shadows),
        .occlusion = occlusion_of(g),
        .flips_v = g->options[OPTION_texture_origin].number != 0,
        .encodes = g->options[OPTION_encode].number != 0,
    };
    g->result->shader.has_two_sources = g->lighting.transparency == TRANSPARENCY_DUAL;
    generation_defer(g);
    g->closure_host.occludes = g->options[OPTION_layering].number == LAYERING_OCCLUDING;
    g->closure_host.keeps_color = g->lighting.transparency == TRANSPARENCY_OPAQUE
                                  || g->lighting.transparency == TRANSPARENCY_MASK;
}

struct shader_layout_rules generation_layout_rules(const struct generation *g)
{
    uint64_t caps = g->result->target->caps;
    return (struct shader_layout_rules){
        .blocks = (caps & CAP_UNIFORM_BLOCKS)
                  || ((caps & CAP_BLOCK_OPTION) && g->options[OPTION_uniform_blocks].number),
        .packing = g->result->target->packing,
        .bindings = caps & CAP_BINDINGS,
        .own_numbers = caps & CAP_OWN_NUMBERS,
        .sampler_bindings = caps & CAP_SAMPLER_BINDINGS,
        .neutral_names = g->options[OPTION_names].number != 0,
        .one_stage = !(caps & CAP_VERTEX_STAGE),
        .typed_textures = caps & CAP_TYPED_TEXTURES,
        .names_wholes = caps & CAP_NAMED_WHOLES,
        .set = (uint32_t)g->options[OPTION_binding_set].number,
        .first_binding = (uint32_t)g->options[OPTION_first_binding].number,
    };
}

static bool emit(struct generation *g)
{
    struct shader *shader = &g->result->shader;
    const struct target_closures *closures = g->result->target->closures;
    generation_name_closures(g);
    if (closures)
        return closures->emit(shader, &g->closure_host, g->root, &g->lacks);
    return closure_emit(shader, &g->closure_host, &g->lighting, g->root);
}

enum { NODES_PER_NODE = 64, MORE_NODES = 1 << 16 }; /* emission adds far fewer nodes */

/* True if lighting the surface reports nothing, as long as the graph has room. */
static bool cannot_fail(const struct generation *g)
{
    const struct ir_graph *graph = &g->result->graph;
    bool has_room = (uint64_t)graph->nodes.len * NODES_PER_NODE + MORE_NODES < graph->max_nodes;
    return has_room && !g->result->target->closures
           && closure_is_surface(&g->result->shader, g->root);
}

static const char *why_not_emitted(const struct generation *g)
{
    const char *not_traced = g->result->shader.reflection.not_traced;
    return not_traced                         ? not_traced
           : g->role->returns == RETURNS_PATH ? "a path tracer draws surfaces, volumes and values"
                                              : gives_nothing;
}

bool generation_emit(struct generation *g)
{
    generation_start_closures(g);
    generation_tell_flat_patterns(g);
    return generation_light(g);
}

bool generation_light(struct generation *g)
{
    assert(g->root > 0 && g->root < g->result->graph.nodes.len);
    bool is_traced = g->role->returns == RETURNS_PATH;
    if (is_traced && g->result->shader.sources.leaves.len) {
        generation_report_not_renderable(
            g, "a path tracer cannot sample closures whose source is for one target");
        return false;
    }
    if (g->desc.only_diagnostics && cannot_fail(g))
        return is_good(g);
    if (g->role->returns == RETURNS_PAYLOAD && !closure_is_surface(&g->result->shader, g->root)) {
        generation_report_not_renderable(g, "a payload holds a surface");
        return false;
    }
    generation_hide_misfits(g);
    if (!generation_budget_slabs(g) || !generation_can_store(g))
        return false;
    generation_walk_slabs(g);
    bool is_emitted = emit(g);
    ir_assert_valid(&g->result->graph, "after closures");
    if (is_emitted && g->role->returns == RETURNS_WORDS
        && !g->result->shader.reflection.stored_words) {
        generation_report_not_renderable(g, generation_why_not_stored(g));
        return false;
    }
    generation_tell_lost_aovs(g);
    if (!is_emitted)
        generation_report_not_renderable(g, why_not_emitted(g));
    if (is_emitted) {
        generation_tell_storage(g);
        generation_tell_lost(g);
        generation_tell_flat_calls(g);
        generation_tell_media(g);
        generation_tell_stand_ins(g);
    }
    return is_good(g) && generation_effects_are_defined(g, &g->result->shader, g->element);
}

/* Passes have no colours of a material. */
static bool has_halves(const struct generation *g)
{
    return g->options[OPTION_precision].number && !role_is_pass(g->role)
           && g->result->target->caps & CAP_MEDIUMP;
}

/* This step reports nothing, and no limit counts the few nodes that it adds. */
bool generation_finish(struct generation *g)
{
    g->result->graph.max_nodes = 0;
    struct shader_layout_rules rules = generation_layout_rules(g);
    shader_finish(&g->result->shader, &rules);
    generation_tell_features(g, has_halves(g));
    return is_good(g);
}

/* ---- Spell ---- */

/*
 * The path of the document node that an IR node comes from. For nodes inside definitions: the path
 * of the document node that uses the definition. NULL: no element.
 */
static const char *origin_path(void *user_data, uint32_t origin)
{
    assert(origin < ((const mxg_result *)user_data)->graph.origins.len);
    mxg_result *result = user_data;
    const struct document *doc = &result->document->layer.doc;
    if (result->origin_paths[origin])
        return result->origin_paths[origin];
    const struct ir_origin *o = &result->graph.origins.items[origin];
    assert(o->parent == 0 || o->parent < origin);
    const char *outer = o->parent ? origin_path(result, o->parent) : NULL;
    if (!o->element)
        return outer;
    struct text path;
    text_init(&path, &result->object.arena);
    if (outer)
        text_fmt(&path, "%s/%s", outer, doc_name(doc, o->element));
    else
        doc_path(doc, o->element, '/', &path);
    return result->origin_paths[origin] = text_cstr(&path);
}

enum { USUAL_SOURCE = 24 << 10 };

static bool spell_one(struct generation *g, const struct spell_options *options,
                      enum shader_stage_id stage)
{
    mxg_result *result = g->result;
    struct text source;
    struct spell_mark *marks;
    struct stage_source *out = &result->stages[stage];
    text_init(&source, &result->object.arena);
    assert(out->size == 0 && out->num_marks == 0);
    text_reserve(&source, USUAL_SOURCE); /* avoids moves while it grows */
    spell_shader_stage(result->target, options, &result->shader, stage, &g->scratch, &source,
                       &marks, &out->num_marks);
    uint32_t limit = result->object.context->max_output_mib;
    if (source.len > (uint64_t)limit << 20) {
        diag_add(diags_of(g), DIAG_ID_output_limit, doc_place(&g->document->layer.doc, g->element),
                 (unsigned)limit);
        return false;
    }
    struct spell_mark *kept = arena_alloc(&result->object.arena, out->num_marks * sizeof *kept);
    if (out->num_marks)
        memcpy(kept, marks, out->num_marks * sizeof *kept);
    out->marks = kept;
    out->text = text_cstr(&source);
    out->size = source.len;
    source_find_lines(out, &result->object.arena);
    return !is_cancelled(g);
}

/*
 * True if the stage has code. A path tracer calls a function instead of a vertex stage, and a
 * target without a vertex stage has only the displacement in it.
 */
bool generation_has_stage(const mxg_result *result, int stage)
{
    const struct shader *shader = &result->shader;
    bool is_idle =
        stage == STAGE_VERTEX
        && (shader->role->stages == STAGES_NONE || shader->stages[stage].statements.len == 0);
    return result->target->stage_suffix[stage] && !is_idle;
}

struct spell_options generation_spell_options(const struct generation *g)
{
    mxg_result *result = g->result;
    return (struct spell_options){
        .version = version_of(g),
        .generator = GENERATOR_NAME,
        .interface = role_is_pass(g->role) ? NULL : g->options[OPTION_interface].text,
        .colorspace = g->options[OPTION_colorspace].text,
        .metadata = (int)g->options[OPTION_metadata].number,
        .vulkan_attributes = g->options[OPTION_hlsl_vulkan].number,
        .comments = g->options[OPTION_comments].number,
        .halves = has_halves(g),
        .user_data = result,
        .path = origin_path,
        .ui = result_ui,
    };
}

bool generation_spell(struct generation *g)
{
    mxg_result *result = g->result;
    assert(result->graph.max_nodes == 0);
    struct spell_options options = generation_spell_options(g);
    result->origin_paths =
        ARENA_ARRAY(&result->object.arena, const char *, result->graph.origins.len);
    for (int stage = 0; stage < NUM_STAGES; stage++)
        if (generation_has_stage(result, stage)
            && !spell_one(g, &options, (enum shader_stage_id)stage))
            return false;
    return is_good(g);
}

/* ---- All steps ---- */

struct run {
    struct generation generation;
    void (*steps)(struct generation *);
};

static void run_steps(void *arg)
{
    struct run *run = arg;
    run->steps(&run->generation);
}

bool generation_names_target(const mxg_generate_desc *desc)
{
    mxg_generate_desc known;
    return desc && struct_read(&known, sizeof known, desc) && known.target;
}

/* True if the description names no stack, or one of the document. */
static bool is_stack_of(const mxg_generate_desc *desc, const mxg_document *document)
{
    const mxg_bindings *bindings = desc->bindings;
    return !bindings
           || (bindings->document == document && !desc->element
               && desc->stack < mxg_bindings_num_stacks(bindings));
}

mxg_status generation_run(mxg_context *context, const mxg_document *document,
                          const mxg_generate_desc *desc, void (*steps)(struct generation *),
                          void *user_data, mxg_result **out_result)
{
    struct run run = {.steps = steps};
    struct generation *g = &run.generation;
    if (out_result)
        *out_result = NULL;
    if (!context || !document || !out_result
        || (desc && !struct_read(&g->desc, sizeof g->desc, desc))
        || !is_stack_of(&g->desc, document))
        return MXG_ERROR_ARGUMENT;
    /* only its reference count changes */
    struct object *below = (struct object *)(uintptr_t)&document->object;
    mxg_result *result = object_new(context, sizeof *result, below);
    if (!result)
        return MXG_ERROR_MEMORY;
    result->document = document;
    g->result = result;
    g->document = document;
    g->user_data = user_data;
    arena_init(&g->scratch, &result->object.mem);
    arena_init(&g->estimates, &result->object.mem);
    file_source_init(&g->files, &result->object);
    g->reader = file_source_for_lang(&g->files);
    diag_list_follow(&result->object.diagnostics.list, &document->object.diagnostics.list);
    mxg_status status = object_run(&result->object, run_steps, &run);
    result->files.items = g->files.names.items;
    result->files.len = g->files.names.len;
    file_source_finish(&g->files);
    arena_finish(&g->scratch);
    arena_finish(&g->estimates);
    object_settle(&result->object);
    if (status != MXG_OK) {
        object_unref(&result->object);
        return status;
    }
    *out_result = result;
    return g->cancelled ? MXG_ERROR_CANCELLED : object_status(&result->object);
}

static void drop_source(mxg_result *result)
{
    for (int stage = 0; stage < NUM_STAGES; stage++)
        result->stages[stage] = (struct stage_source){0};
}

bool generation_shade(struct generation *g)
{
    return generation_emit(g) && (!g->desc.only_diagnostics || g->desc.bindings)
           && generation_finish(g) && generation_keeps_textures(g) && generation_keeps_attributes(g)
           && generation_keeps_outputs(g) && !g->desc.only_diagnostics;
}

void generation_run_all(struct generation *g)
{
    bool built = generation_start(g) && generation_build(g);
    if (g->result->network.arena)
        g->result->has_shader = built && generation_make_network(g);
    else
        g->result->has_shader =
            built && generation_shade(g) && (g->desc.without_source || generation_spell(g));
    if (!g->result->has_shader)
        drop_source(g->result);
    assert(!g->result->has_shader || diags_of(g)->num_errors == 0);
}

mxg_status mxg_generate(mxg_context *context, const mxg_document *document,
                        const mxg_generate_desc *desc, mxg_result **out_result)
{
    if (out_result)
        *out_result = NULL;
    if (!generation_names_target(desc))
        return MXG_ERROR_ARGUMENT;
    return generation_run(context, document, desc, generation_run_all, NULL, out_result);
}

void mxg_result_destroy(mxg_result *result)
{
    object_unref(result ? &result->object : NULL);
}

const mxg_diagnostics *mxg_result_diagnostics(const mxg_result *result)
{
    return result ? &result->object.diagnostics : NULL;
}
