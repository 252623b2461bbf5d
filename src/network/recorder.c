// SPDX-License-Identifier: Apache-2.0
/*
 * Networks: the builder inspects the results of a node, discards them, and records an OSL layer
 * instead. The layer's outputs are sources of unknown value. So flattening of graphs, values,
 * tokens, conversions and the removal of trivial nodes work as for any shader:
 *
 *     multiply(in1, 1)       →  in1
 *     mix of two constants   →  a constant
 *     layer(top, nothing)    →  top
 *
 * Closures and shaders stay as they are, so that the tree of an element is complete. The builder
 * notes the layer of each, and uses the layers if all of the tree has them. Slabs have none, nor
 * have the slots of a stack, films over other closures, and nodes over surfaces with AOVs. Then the
 * tree becomes one shader, as without a network, and the sources in it become its parameters.
 */
#include "build/recorder.h"

#include "base/hash.h"

void build_record_network(struct builder *b, struct network *network, const char *end_layer,
                          bool (*fits_family)(const char *family, const uint32_t *functions))
{
    struct recorder *r = ARENA_NEW(b->arena, struct recorder);
    *network =
        (struct network){.arena = b->arena, .strings = b->shader->strings, .end_layer = end_layer};
    r->network = network;
    r->fits_family = fits_family;
    names_init(&r->names, b->arena, b->shader->style->syntax);
    names_take_frame(&r->names, b->shader);
    names_take(&r->names, end_layer, strlen(end_layer));
    b->recorder = r;
}

void build_leave_layer(struct builder *b)
{
    if (b->recorder)
        b->recorder->is_changed = true;
}

/* Element `index` of an array that grows on demand. */
static uint32_t *at(struct arena *arena, uint32_t **items, uint32_t *len, uint32_t index)
{
    if (index >= *len) {
        uint32_t more = index + index / 2 + 64;
        uint32_t *grown = ARENA_ARRAY(arena, uint32_t, more);
        if (*len)
            memcpy(grown, *items, *len * sizeof *grown);
        *items = grown;
        *len = more;
        assert(index < *len);
    }
    return &(*items)[index];
}

/* ---- Inputs that are compiled into the layer's shader ---- */

/*
 * True for strings, which choose code; for nodes with dynamic implementations, which read streams
 * by index or have a default for geometry without a property; for profiles; and for the uniform
 * inputs of nodes in C, which may read their values.
 */
static bool is_settled(const struct builder *b, const struct implementation *impl,
                       const struct port *port)
{
    ir_type_id type = library_type_ir(b->lib, port->type);
    bool is_read_by_code = impl->kind == IMPL_DYNAMIC
                           && (port->name == STR_index || port->name == STR_default
                               || port->name == STR_fallback || type == IR_TYPE_SAMPLER);
    bool is_uniform =
        impl->kind == IMPL_CODE && port->flags & PORT_UNIFORM && build_is_number(type);
    return type == IR_TYPE_STRING || is_read_by_code || is_uniform;
}

/* The part of a file name that is compiled in: the whole name for dynamic implementations. */
static str_id settled_file(struct builder *b, const struct implementation *impl, str_id file)
{
    return impl->kind == IMPL_DYNAMIC ? file : recorder_tiles(b, file);
}

/* The value that is compiled in; type VOID: none. */
static struct ir_value settled_value(struct builder *b, const struct implementation *impl,
                                     const struct port *port, ir_ref arg)
{
    struct ir_value value = {.type = IR_TYPE_VOID};
    const struct ir_node *node = ir_get(b->graph, arg);
    if (node->op == IR_TEXTURE) {
        str_id file = settled_file(b, impl, b->shader->interface.variables.items[node->attr].file);
        if (file)
            value = (struct ir_value){.type = IR_TYPE_SAMPLER, .w[0].u = file};
    } else if (is_settled(b, impl, port)) {
        build_initial(b, arg, &value);
    }
    return value;
}

struct ir_value build_network_default(struct builder *b, const struct port *port)
{
    struct ir_value value = {.type = library_type_ir(b->lib, port->type)};
    if (value.type == IR_TYPE_STRING || value.type == IR_TYPE_SAMPLER)
        value.w[0].u = port->value;
    else if (!port->geomprop && port->value && (port->flags & PORT_HAS_VALUE))
        build_initial(b, build_default(b, port), &value);
    return value;
}

static void add_word(struct text *name, const char *word)
{
    if (strcmp(word, "<UDIM>") == 0)
        word = "tiles";
    bool is_plain = *word != '\0';
    text_char(name, '_');
    for (const char *c = word; *c; c++) {
        bool is_word = (*c >= '0' && *c <= '9') || ((*c | 0x20) >= 'a' && (*c | 0x20) <= 'z');
        text_char(name, is_word ? *c : '_');
        is_plain &= is_word;
    }
    if (!is_plain) /* other strings may give the same code */
        text_fmt(name, "x%u", (unsigned)hash_stable(0, word, strlen(word)));
}

static bool is_same_value(const struct ir_value *a, const struct ir_value *b)
{
    bool is_number = build_is_number(a->type);
    return a->type == b->type && (is_number ? ir_value_equal(a, b) : a->w[0].u == b->w[0].u);
}

/* The value in a name: the number of an integer, a word, or a hash. */
static void add_value(struct builder *b, struct text *name, const struct ir_value *value)
{
    struct text text;
    text_init(&text, b->arena);
    if (value->type == IR_TYPE_INT)
        text_fmt(&text, "%d", value->w[0].i);
    else if (build_is_number(value->type))
        text_fmt(&text, "%u",
                 (unsigned)hash_stable(0, value->w, ir_type_info(value->type)->components * 4u));
    else
        text_str(&text, build_text(b, value->w[0].u));
    add_word(name, text_cstr(&text));
}

/*
 * The name of a layer's shader: the definition's name, and the mode if it is not the default:
 * "ND_dielectric_bsdf_scatter_mode_T" for "ND_dielectric_bsdf".
 */
static str_id node_name(struct builder *b, const struct nodedef *def, const struct port *ports,
                        const struct ir_value *fixed)
{
    struct text name;
    text_init(&name, b->arena);
    text_str(&name, build_text(b, def->name));
    for (unsigned i = 0; i < def->num_inputs; i++) {
        struct ir_value usual = build_network_default(b, &ports[i]);
        if (fixed[i].type == IR_TYPE_VOID || is_same_value(&fixed[i], &usual))
            continue;
        text_fmt(&name, "_%s", build_text(b, ports[i].name));
        add_value(b, &name, &fixed[i]);
    }
    size_t len;
    const char *identifier = identifier_from(text_cstr(&name), name.len, b->arena, &len);
    return str_intern(b->shader->strings, identifier, len);
}

static uint32_t node_of(struct builder *b, const struct frame *frame)
{
    assert(frame->impl->nodedef == frame->node.nodedef);
    struct network *network = b->recorder->network;
    const struct nodedef *def = library_nodedef(b->lib, frame->node.nodedef);
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    struct ir_value *fixed = ARENA_ARRAY(b->arena, struct ir_value, def->num_inputs);
    str_id *names = ARENA_ARRAY(b->arena, str_id, def->num_inputs);
    for (unsigned i = 0; i < def->num_inputs; i++) {
        names[i] = ports[i].name;
        if (frame->args[i])
            fixed[i] = settled_value(b, frame->impl, &ports[i], frame->args[i]);
    }
    for (uint32_t n = 0; n < network->nodes.len; n++) {
        const struct network_node *node = &network->nodes.items[n];
        bool is_same = node->definition == frame->node.nodedef;
        for (unsigned i = 0; i < def->num_inputs && is_same; i++)
            is_same = is_same_value(&fixed[i], &node->fixed[i]);
        if (is_same)
            return n;
    }
    vec_push(b->arena, &network->nodes,
             (struct network_node){.name = node_name(b, def, ports, fixed),
                                   .definition = frame->node.nodedef,
                                   .fixed = fixed,
                                   .num_inputs = def->num_inputs,
                                   .num_outputs = def->num_outputs,
                                   .ports = names,
                                   .definition_name = def->name});
    return network->nodes.len - 1;
}

/* ---- Inputs ---- */

static ir_ref known_source(const struct recorder *r, ir_ref value)
{
    return value < r->num_sources ? r->source_of[value] : 0;
}

static struct network_input input_of(struct builder *b, ir_ref arg)
{
    struct recorder *r = b->recorder;
    struct network_input input = {.kind = NETWORK_DEFAULT};
    if (!arg)
        return input;
    if (known_source(r, arg))
        arg = known_source(r, arg);
    const struct ir_node *node = ir_get(b->graph, arg);
    const struct shader_variable *variable = NULL;
    input.type = node->type;
    if (node->op == IR_UNIFORM || node->op == IR_STREAM || node->op == IR_TEXTURE)
        variable = &b->shader->interface.variables.items[node->attr];
    if (variable && recorder_layer_of(r, node->attr)) {
        input.kind = NETWORK_LAYER;
        input.layer = recorder_layer_of(r, node->attr) - 1;
        input.output = r->output_of.items[node->attr];
    } else if (node->op == IR_TEXTURE) {
        input.kind = NETWORK_FILE;
        input.file = variable->file;
        input.path = variable->path;
    } else if (ir_get_const(b->graph, arg, &input.value)) {
        input.kind = NETWORK_VALUE;
    } else { /* a uniform, perhaps in another unit: the host sets the converted value */
        if (build_evaluate(b, arg, &input.value))
            input.kind = NETWORK_VALUE;
        if (node->op == IR_UNIFORM)
            input.path = variable->path;
    }
    return input;
}

/* A surface without the AOVs that are no outputs. */
static ir_ref without_unasked(const struct builder *b, ir_ref surface)
{
    while (surface && b->shader->interface.lists_aovs && ir_get(b->graph, surface)->op == IR_AOV
           && ir_get(b->graph, surface)->attr >= b->shader->interface.num_listed_aovs)
        surface = ir_arg(b->graph, surface, 0);
    return surface;
}

static bool is_shading(const struct builder *b, ir_ref value)
{
    ir_type_id type = ir_type_of(b->graph, value);
    return ir_type_is_closure(type) || ir_type_is_shader(type);
}

/* False for a closure or shader that no layer gives. */
static bool has_layer(const struct builder *b, ir_ref value)
{
    return !value || !is_shading(b, value) || ir_get(b->graph, value)->op == IR_POISON
           || known_source(b->recorder, value);
}

static void add_input(struct builder *b, const struct frame *frame, const struct port *port,
                      ir_ref arg)
{
    struct network_input input = {.kind = NETWORK_DEFAULT};
    if (!is_settled(b, frame->impl, port))
        input = input_of(b, without_unasked(b, arg));
    input.doc_type = library_type_name(b->lib, port->type);
    struct ir_value usual = build_network_default(b, port);
    bool is_usual = input.kind == NETWORK_VALUE && !input.path && !port->geomprop
                    && build_is_number(usual.type) && ir_value_equal(&input.value, &usual);
    if (is_usual)
        input.kind = NETWORK_DEFAULT;
    vec_push(b->arena, &b->recorder->network->inputs, input);
}

/* ---- Layers ---- */

/* The path of the document node behind the current node: "NG_marble/noise". */
static void write_path(const struct builder *b, uint32_t origin, char between, struct text *out)
{
    const struct ir_origin *o = &b->graph->origins.items[origin];
    if (o->parent) {
        write_path(b, o->parent, between, out);
        text_char(out, between);
    } else if (o->element) {
        doc_path(&b->lib->doc, o->element, between, out);
        return;
    }
    text_str(out, build_text(b, o->name));
}

/*
 * The path of a node. A node without a document element, such as a conversion, adds its name to the
 * path of the node that needs it.
 */
static str_id path_of(struct builder *b, const struct frame *frame, char between)
{
    struct text path;
    text_init(&path, b->arena);
    if (b->slot && between == '_') /* layers of a stack may share nodes */
        text_fmt(&path, "%s_", build_text(b, b->slot));
    write_path(b, b->graph->origin, between, &path);
    if (!frame->scope && b->graph->origins.items[b->graph->origin].element)
        text_fmt(&path, "%c%s", between,
                 build_text(b, library_nodedef(b->lib, frame->node.nodedef)->node));
    return str_intern(b->shader->strings, path.data, path.len);
}

/* Adds a source of unknown value. */
static ir_ref add_source(struct builder *b, ir_type_id type, uint32_t layer, unsigned output)
{
    assert(output < LIBRARY_MAX_OUTPUTS && layer <= b->recorder->network->layers.len);
    struct recorder *r = b->recorder;
    uint32_t variable = shader_add_variable(
        b->shader,
        &(struct shader_variable){.name = str_intern_z(b->shader->strings, "layer_output"),
                                  .block = BLOCK_VERTEX_DATA,
                                  .type = type});
    *at(b->arena, &r->layer_of, &r->num_layers_of, variable) = layer + 1;
    while (r->output_of.len <= variable)
        vec_push(b->arena, &r->output_of, 0);
    r->output_of.items[variable] = (uint8_t)output;
    assert(variable < r->num_layers_of && variable < r->output_of.len);
    return ir_build(b->graph, IR_STREAM, type, variable, NULL, 0);
}

static bool is_argument(const struct builder *b, const struct frame *frame, ir_ref value)
{
    for (unsigned i = 0; i < library_nodedef(b->lib, frame->node.nodedef)->num_inputs; i++)
        if (frame->args[i] == value)
            return true;
    return false;
}

/*
 * True if the value needs no layer: a constant, no closure, an output of another layer, or an
 * argument.
 */
static bool is_plain(const struct builder *b, const struct frame *frame, ir_ref value)
{
    const struct ir_node *node = ir_get(b->graph, value);
    bool is_source = node->op == IR_STREAM && recorder_layer_of(b->recorder, node->attr);
    return !value || node->op == IR_CONST || node->op == IR_POISON || node->type == IR_TYPE_MATERIAL
           || is_source || is_argument(b, frame, value);
}

enum { MAX_LAYERS = 16384 };

/*
 * A definition by a nodegraph becomes layers at each use, so nested definitions may need more
 * layers than a document has elements, exponentially more.
 */
static bool has_room(struct builder *b, const struct frame *frame)
{
    struct recorder *r = b->recorder;
    if (!r->is_full && r->network->layers.len >= MAX_LAYERS) {
        r->is_full = true;
        diag_add(b->diags, DIAG_ID_network_limit, doc_place(build_doc(b), frame->node.element),
                 MAX_LAYERS);
    }
    return !r->is_full;
}

bool build_network_is_full(const struct builder *b)
{
    return b->recorder && b->recorder->is_full;
}

static str_id layer_name(struct builder *b, str_id wanted)
{
    const char *text = build_text(b, wanted);
    struct spell_name name =
        names_unique(&b->recorder->names, text, str_len(b->shader->strings, wanted));
    return str_intern(b->shader->strings, name.text, name.len);
}

static void add_layer(struct builder *b, const struct frame *frame)
{
    struct network *network = b->recorder->network;
    const struct port *ports = library_ports(b->lib, frame->node.nodedef, NULL);
    unsigned num_inputs = library_nodedef(b->lib, frame->node.nodedef)->num_inputs;
    struct network_layer made = {.name = layer_name(b, path_of(b, frame, '_')),
                                 .path = path_of(b, frame, '/'),
                                 .node = node_of(b, frame),
                                 .first_input = network->inputs.len};
    for (unsigned i = 0; i < num_inputs; i++)
        add_input(b, frame, &ports[i], frame->args[i]);
    assert(made.node < network->nodes.len);
    assert(network->inputs.len == made.first_input + num_inputs);
    vec_push(b->arena, &network->layers, made);
}

/* True for a BSDF that the language has no closure for: what stands for it needs its values. */
static bool lacks_closure(const struct builder *b, const struct implementation *impl)
{
    if (impl->kind != IMPL_FAMILY)
        return false;
    const struct family *family = library_family(b->lib, impl->ref);
    const struct port *ports = library_ports(b->lib, impl->nodedef, NULL);
    ir_type_id type =
        library_type_ir(b->lib, ports[library_nodedef(b->lib, impl->nodedef)->num_inputs].type);
    return type == IR_TYPE_BSDF
           && b->recorder->fits_family(build_text(b, family->name), family->functions);
}

/* True if the closures that the node gives are no outputs of a layer. */
static bool is_changed(struct builder *b, const struct frame *frame)
{
    unsigned num_inputs = library_nodedef(b->lib, frame->node.nodedef)->num_inputs;
    bool is_changed = b->recorder->is_changed || lacks_closure(b, frame->impl);
    b->recorder->is_changed = false;
    for (unsigned i = 0; i < num_inputs; i++)
        is_changed |= !has_layer(b, without_unasked(b, frame->args[i]));
    return is_changed;
}

void build_record_node(struct builder *b, const struct frame *frame, ir_ref *results)
{
    struct recorder *r = b->recorder;
    unsigned num_outputs = library_nodedef(b->lib, frame->node.nodedef)->num_outputs;
    uint32_t layer = r->network->layers.len;
    bool is_new = false, changed = is_changed(b, frame), gives[LIBRARY_MAX_OUTPUTS];
    if (!has_room(b, frame))
        return;
    for (unsigned i = 0; i < num_outputs; i++) {
        gives[i] = !is_plain(b, frame, results[i]) && !(changed && is_shading(b, results[i]));
        is_new |= gives[i] && !known_source(r, results[i]);
    }
    if (is_new)
        add_layer(b, frame);
    for (unsigned i = 0; i < num_outputs; i++) {
        if (!gives[i])
            continue;
        ir_ref source = known_source(r, results[i]);
        if (!source) {
            assert(is_new && layer + 1 == r->network->layers.len);
            source = add_source(b, ir_type_of(b->graph, results[i]), layer, i);
            *at(b->arena, &r->source_of, &r->num_sources, results[i]) = source;
        }
        if (!is_shading(b, results[i]))
            results[i] = source;
    }
}

/*
 * A constant layer for a value that no layer gives; UINT32_MAX: the library has none for its type.
 */
static uint32_t constant_layer(struct builder *b, ir_ref value, str_id type)
{
    struct frame frame = {.node = {.nodedef = build_definition_of(b, "constant", type)},
                          .args = &value};
    if (frame.node.nodedef == LIBRARY_NONE
        || !(frame.impl = build_choose(b, frame.node.nodedef, 0)))
        return UINT32_MAX;
    struct network *network = b->recorder->network;
    struct network_layer layer = {.node = node_of(b, &frame), .first_input = network->inputs.len};
    add_input(b, &frame, library_ports(b->lib, frame.node.nodedef, NULL), value);
    layer.name = layer.path = layer_name(b, str_intern_z(b->shader->strings, "constant"));
    vec_push(b->arena, &network->layers, layer);
    return network->layers.len - 1;
}

/* ---- Results ---- */

/* From a layer; if there is none, from one that is made for a constant. */
static bool give_layer(struct builder *b, ir_ref value, str_id type, struct network_input *input)
{
    if (input->kind != NETWORK_LAYER) {
        input->layer = constant_layer(b, value, type);
        input->kind = NETWORK_LAYER;
    }
    return input->layer < b->recorder->network->layers.len;
}

/* The number of AOVs that may be outputs. */
static uint32_t num_aovs(const struct shader *shader)
{
    return shader->interface.lists_aovs ? shader->interface.num_listed_aovs
                                        : shader->interface.aovs.len;
}

/* Takes the AOVs off a surface: the values, by number, of those that have none yet. */
static ir_ref take_aovs(struct builder *b, ir_ref surface, ir_ref *values)
{
    struct network *network = b->recorder->network;
    ir_ref *own = ARENA_ARRAY(b->arena, ir_ref, b->shader->interface.aovs.len);
    for (; surface && ir_get(b->graph, surface)->op == IR_AOV;
         surface = ir_arg(b->graph, surface, 0)) {
        uint32_t number = ir_get(b->graph, surface)->attr;
        if (!own[number]) /* the outer one replaces it */
            own[number] = ir_arg(b->graph, surface, 1);
    }
    for (uint32_t i = 0; i < num_aovs(b->shader); i++) {
        /* a layer cannot tell the front from the back */
        bool is_second = own[i] && values[i] && own[i] != values[i];
        network->is_whole |= is_second || !has_layer(b, own[i]);
        if (own[i] && !values[i])
            values[i] = own[i];
    }
    network->is_whole |= !has_layer(b, surface);
    return surface;
}

static void add_aovs(struct builder *b, const ir_ref *values)
{
    for (uint32_t i = 0; i < num_aovs(b->shader); i++) {
        const struct shader_aov *from = &b->shader->interface.aovs.items[i];
        const struct aov_use use = {.node = from->element, .name = from->name};
        struct network_aov aov = {.name = from->name, .doc_type = from->doc_type};
        if (!values[i])
            continue;
        aov.value = input_of(b, values[i]);
        if (give_layer(b, values[i], from->doc_type, &aov.value))
            vec_push(b->arena, &b->recorder->network->aovs, aov);
        else
            build_leave_out_aov(b, &use, "no layer gives its value");
    }
}

static enum network_result result_of(ir_type_id type)
{
    if (type == IR_TYPE_DISPLACEMENT)
        return NETWORK_DISPLACEMENT;
    if (type == IR_TYPE_VOLUME || type == IR_TYPE_VDF)
        return NETWORK_VOLUME;
    return ir_type_is_closure(type) || ir_type_is_shader(type) ? NETWORK_SURFACE
                                                               : NETWORK_PLAIN_VALUE;
}

static void find_material(struct builder *b, ir_ref material)
{
    struct network *network = b->recorder->network;
    ir_ref *aovs = ARENA_ARRAY(b->arena, ir_ref, b->shader->interface.aovs.len),
           parts[NETWORK_PLAIN_VALUE];
    for (unsigned i = 0; i < NETWORK_PLAIN_VALUE; i++)
        parts[i] = take_aovs(b, ir_arg(b->graph, material, i), aovs);
    if (network->is_whole)
        return;
    for (unsigned i = 0; i < NETWORK_PLAIN_VALUE; i++)
        network->results[i] = input_of(b, parts[i]);
    add_aovs(b, aovs);
    if (!parts[NETWORK_SURFACE] && !parts[NETWORK_BACK_SURFACE] && !parts[NETWORK_VOLUME])
        network->results[NETWORK_SURFACE].type = IR_TYPE_SURFACE; /* a black surface */
}

static bool find_element(struct builder *b, ir_ref root, str_id type)
{
    struct network *network = b->recorder->network;
    ir_ref *aovs = ARENA_ARRAY(b->arena, ir_ref, b->shader->interface.aovs.len);
    enum network_result result = result_of(ir_type_of(b->graph, root));
    struct network_input *input = &network->results[result];
    root = take_aovs(b, root, aovs);
    if (network->is_whole)
        return true;
    *input = input_of(b, root);
    add_aovs(b, aovs);
    return result != NETWORK_PLAIN_VALUE || give_layer(b, root, type, input);
}

bool build_network_results(struct builder *b, ir_ref root, str_id type)
{
    bool good = true;
    if (ir_get(b->graph, root)->op == IR_MATERIAL)
        find_material(b, root);
    else
        good = find_element(b, root, type);
    b->recorded = b->recorder;
    b->recorder = NULL; /* what a whole shader adds is in it */
    return good;
}
