// SPDX-License-Identifier: Apache-2.0
/* Nodes in C: the values that their code builds, in every target, and code that misbehaves. */
#include "fixture.h"

static const char definitions[] =
    "<nodedef name='ND_probe' node='probe'>"
    "<input name='in' type='float' value='0.25'/>"
    "<input name='number' type='integer' value='2' uniform='true'/>"
    "<input name='word' type='string' value='plain' uniform='true'/>"
    "<input name='tint' type='color3' value='1, 0.5, 0.25'/>"
    "<input name='file' type='filename' value='' uniform='true'/>"
    "<output name='out' type='float'/></nodedef>"
    "<nodedef name='ND_pair' node='pair'><input name='in' type='float' value='1'/>"
    "<output name='a' type='float'/><output name='b' type='vector3'/></nodedef>"
    "<nodedef name='ND_skin' node='skin'><input name='color' type='color3' value='1, 0, 0'/>"
    "<input name='under' type='BSDF' value=''/><output name='out' type='BSDF'/></nodedef>"
    "<nodedef name='ND_loop' node='loop'><input name='in' type='float' value='1'/>"
    "<output name='out' type='float'/></nodedef>"
    "<nodegraph name='NG_loop' nodedef='ND_loop'><probe name='p' type='float'>"
    "<input name='in' type='float' interfacename='in'/></probe>"
    "<output name='out' type='float' nodename='p'/></nodegraph>";

struct host {
    mxg_context *context;
    mxg_library *library;
    mxg_document *document;
    mxg_result *result;
    mxg_status status;
};

struct run {
    mxg_build_fn build;
    void *user_data;
    uint64_t version;
    const char *target, *instead, *of_target, *body;
    size_t max_memory;
    uint32_t max_nodes;
    const char *name, *option, *value;
};

/* A use of <probe>, of the name `use`, with `body` as its inputs. */
static void open_host(struct host *h, const struct run *run)
{
    char text[4096];
    const mxg_node_code code = {.size = sizeof code,
                                .name = run->name ? run->name : "ND_probe",
                                .target = run->target,
                                .version = run->version,
                                .build = run->build,
                                .user_data = run->user_data,
                                .instead = run->instead};
    const mxg_node_code *const codes[] = {&code};
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    desc.node_codes = codes;
    desc.num_node_codes = 1;
    desc.max_memory = run->max_memory;
    desc.max_nodes = run->max_nodes;
    memset(h, 0, sizeof *h);
    REQUIRE_EQ(mxg_context_create(&desc, &h->context), MXG_OK);
    h->library = mxg_library_builtin(h->context);
    snprintf(text, sizeof text, "<materialx version='1.39'>%s\n%s</materialx>", definitions,
             run->body ? run->body
                       : "<probe name='use' type='float'/>"
                         "<output name='M' type='float' nodename='use'/>");
    h->status =
        mxg_document_parse(h->context, h->library, "code.mtlx", text, strlen(text), &h->document);
    REQUIRE_EQ(h->status, MXG_OK);
    mxg_options *options = NULL;
    mxg_options_create(h->context, &options);
    if (run->option)
        REQUIRE_EQ(mxg_options_set(options, run->option, run->value), MXG_OK);
    mxg_generate_desc generate = MXG_GENERATE_DESC_INIT;
    generate.target = run->of_target ? run->of_target : "vulkan";
    generate.element = "M";
    generate.options = options;
    h->status = mxg_generate(h->context, h->document, &generate, &h->result);
    mxg_options_destroy(options);
}

static void close_host(struct host *h)
{
    mxg_result_destroy(h->result);
    mxg_document_destroy(h->document);
    mxg_library_unref(h->library);
    mxg_context_destroy(h->context);
}

static bool has_text(const struct host *h, mxg_stage stage, const char *text)
{
    const char *source = mxg_result_source(h->result, stage, NULL);
    return source && strstr(source, text);
}

/* ---- What code can build ---- */

static bool build_everything(void *user_data, mxg_build *build, mxg_ref *results)
{
    static const char *const names[] = {"x", "word", "tint", "n"};
    const float half = 0.5f, numbers[] = {1, 2, 3}, step = 7;
    mxg_build_info info = MXG_INIT(mxg_build_info);
    mxg_value value = MXG_INIT(mxg_value);
    const char *type = NULL;
    (void)user_data;
    REQUIRE_EQ(mxg_build_use(build, &info), MXG_OK);
    REQUIRE_STR(info.nodedef, "ND_probe");
    REQUIRE_STR(info.node, "probe");
    REQUIRE_EQ(info.num_inputs, 5);
    REQUIRE_EQ(info.num_outputs, 1);
    REQUIRE_STR(mxg_build_port(build, 3, &type), "tint");
    REQUIRE_STR(type, "vec3");
    REQUIRE_STR(mxg_build_port(build, 5, &type), "out");
    REQUIRE(mxg_build_port(build, 6, &type) == NULL);

    mxg_ref in = mxg_build_input(build, "in"), tint = mxg_build_input(build, "tint");
    REQUIRE_STR(mxg_build_type(build, tint), "vec3");
    REQUIRE(!mxg_build_value(build, mxg_build_stream(build, "normalWorld", NULL), &value));
    REQUIRE(mxg_build_value(build, mxg_build_number(build, "vec3", numbers, 3), &value));
    REQUIRE_EQ(value.num_values, 3);
    REQUIRE_EQ((int)value.values[2], 3);
    REQUIRE(mxg_build_require_constant(build, "word", &value));
    REQUIRE_STR(value.text, "plain");
    REQUIRE_STR(value.type, "string");
    REQUIRE(mxg_build_require_constant(build, "number", &value));
    REQUIRE_EQ(value.integer, 2);

    mxg_ref n =
        mxg_build_op(build, "convert", "float", (mxg_ref[]){mxg_build_input(build, "number")}, 1);
    const mxg_ref args[] = {in, mxg_build_string(build, "word"), tint, n};
    mxg_ref sum = mxg_build_expression(
        build, "float", "{{x}} * 3.0 + ({{word}} == \"word\" ? {{tint}}.y : {{n}}) + {{n}}", names,
        args, 4);
    mxg_ref facing = mxg_build_op(
        build, "dot", NULL, (mxg_ref[]){mxg_build_stream(build, "normalWorld", NULL), tint}, 2);
    const mxg_build_uniform uniform = {.size = sizeof uniform,
                                       .name = "u_studioStep",
                                       .type = "float",
                                       .semantic = "studioStep",
                                       .values = &step,
                                       .num_values = 1};
    mxg_ref parts[] = {sum, facing, mxg_build_add_uniform(build, &uniform)};
    mxg_ref vector = mxg_build_op(build, "construct", "vec3", parts, 3);
    mxg_ref noise, halves[] = {mxg_build_swizzle(build, vector, "zyx"),
                               mxg_build_number(build, "float", &half, 1)};
    static const char *const inputs[] = {"position", "amplitude"};
    REQUIRE(mxg_build_node(build, "ND_noise3d_float", inputs, halves, 2, &noise, 1));
    results[0] = noise;
    return true;
}

static void test_values(void)
{
    for (uint32_t i = 0; i < mxg_catalogue_num_targets(); i++) {
        mxg_target target = MXG_INIT(mxg_target);
        struct host h;
        mxg_catalogue_target(i, &target);
        open_host(&h, &(struct run){.build = build_everything, .of_target = target.name});
        REQUIRE_EQ(h.status, MXG_OK);
        REQUIRE(has_text(&h, MXG_STAGE_PIXEL, "noise"));
        REQUIRE(has_text(&h, MXG_STAGE_PIXEL, "studioStep"));
        close_host(&h);
    }
    struct host h;
    open_host(&h, &(struct run){.build = build_everything});
    uint32_t found = 0;
    for (uint32_t i = 0; i < mxg_result_num_variables(h.result); i++) {
        mxg_variable v = MXG_INIT(mxg_variable);
        mxg_result_variable(h.result, i, &v);
        if (strcmp(v.semantic, "studioStep") != 0)
            continue;
        REQUIRE_EQ(v.block, MXG_BLOCK_PRIVATE_UNIFORMS);
        REQUIRE_EQ((int)v.values[0], 7);
        found++;
    }
    REQUIRE_EQ(found, 1);
    REQUIRE_EQ(mxg_result_input_state(h.result, "use/number"), MXG_INPUT_COMPILED);
    REQUIRE_EQ(mxg_result_input_state(h.result, "use/in"), MXG_INPUT_UNIFORM);
    close_host(&h);
}

/* Two blocks of the host, in the order of their declaration; a name is in each. */
static bool build_blocks(void *user_data, mxg_build *build, mxg_ref *results)
{
    static const struct {
        const char *block, *name, *type;
        float value;
    } rows[] = {{"Shot", "u_wind", "vec3", 2},
                {"Frame", "u_wind", "float", 3},
                {"Shot", "u_gust", "float", 4},
                {"Shot", "u_wind", "vec3", 2}};
    (void)user_data;
    results[0] = mxg_build_input(build, "in");
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        const float values[] = {rows[i].value, rows[i].value, rows[i].value};
        bool is_vector = strcmp(rows[i].type, "vec3") == 0;
        mxg_ref value =
            mxg_build_add_uniform(build, &(mxg_build_uniform){.size = sizeof(mxg_build_uniform),
                                                              .name = rows[i].name,
                                                              .type = rows[i].type,
                                                              .values = values,
                                                              .num_values = is_vector ? 3 : 1,
                                                              .block = rows[i].block});
        mxg_ref args[] = {results[0], is_vector ? mxg_build_swizzle(build, value, "z") : value};
        results[0] = mxg_build_op(build, "add", NULL, args, 2);
    }
    return true;
}

static void test_own_blocks(void)
{
    for (uint32_t i = 0; i < mxg_catalogue_num_targets(); i++) {
        mxg_target target = MXG_INIT(mxg_target);
        struct host h;
        mxg_catalogue_target(i, &target);
        open_host(&h, &(struct run){.build = build_blocks, .of_target = target.name});
        REQUIRE_EQ(h.status, MXG_OK);
        REQUIRE(has_text(&h, MXG_STAGE_PIXEL, "gust"));
        close_host(&h);
    }
    struct host h;
    open_host(&h, &(struct run){.build = build_blocks});
    REQUIRE(has_text(&h, MXG_STAGE_PIXEL,
                     "layout(set = 0, binding = 3, std140) uniform Shot {\n    vec3 u_wind;\n"
                     "    float u_gust;\n};\n"));
    REQUIRE(has_text(&h, MXG_STAGE_PIXEL, "binding = 4, std140) uniform Frame {"));
    mxg_block_info shot = MXG_INIT(mxg_block_info), frame = MXG_INIT(mxg_block_info),
                   none = MXG_INIT(mxg_block_info);
    REQUIRE_EQ(mxg_result_block(h.result, MXG_BLOCK_OWN_1, &shot), MXG_OK);
    REQUIRE_EQ(mxg_result_block(h.result, MXG_BLOCK_OWN_2, &frame), MXG_OK);
    REQUIRE_EQ(mxg_result_block(h.result, MXG_BLOCK_OWN_3, &none), MXG_OK);
    REQUIRE_STR(shot.name, "Shot");
    REQUIRE_STR(frame.name, "Frame");
    REQUIRE_STR(none.name, "");
    REQUIRE_EQ(shot.num_variables, 2);
    REQUIRE_EQ(none.num_variables, 0);
    REQUIRE_EQ(frame.binding, 4);
    REQUIRE_EQ(shot.byte_size, 16);
    float bytes[4] = {0};
    REQUIRE_EQ(mxg_result_pack_block(h.result, NULL, MXG_BLOCK_OWN_1, bytes, sizeof bytes), MXG_OK);
    REQUIRE(bytes[0] == 2 && bytes[2] == 2 && bytes[3] == 4);
    mxg_variable v = MXG_INIT(mxg_variable);
    REQUIRE_EQ(mxg_result_variable(h.result, shot.first_variable + 1, &v), MXG_OK);
    REQUIRE_STR(v.name, "u_gust");
    REQUIRE_EQ(v.offset, 12);
    REQUIRE_EQ(v.block, MXG_BLOCK_OWN_1);
    REQUIRE(strstr(mxg_result_reflection_json(h.result, NULL), "\"Shot\""));
    close_host(&h);
}

/* An expression in C gives the text of the same expression in a library. */
static bool build_same(void *user_data, mxg_build *build, mxg_ref *results)
{
    static const char *const names[] = {"in", "tint"};
    const mxg_ref args[] = {mxg_build_input(build, "in"), mxg_build_input(build, "tint")};
    (void)user_data;
    results[0] =
        mxg_build_expression(build, "float", "sin({{in}}) * {{tint}}.x + {{in}}", names, args, 2);
    return true;
}

static void test_same_as_library(void)
{
    static const char with_source[] =
        "<implementation name='IM_probe' nodedef='ND_probe' "
        "sourcecode='sin({{in}}) * {{tint}}.x + {{in}}'/>"
        "<probe name='use' type='float'/><output name='M' type='float' nodename='use'/>";
    struct host a, b;
    open_host(&a, &(struct run){.build = build_same});
    open_host(&b, &(struct run){.build = build_same, .name = "ND_loop", .body = with_source});
    REQUIRE_STR(mxg_result_source(a.result, MXG_STAGE_PIXEL, NULL),
                mxg_result_source(b.result, MXG_STAGE_PIXEL, NULL));
    mxg_nodedef def = MXG_INIT(mxg_nodedef);
    for (uint32_t i = 0; i < mxg_document_num_nodedefs(a.document); i++)
        if (mxg_document_nodedef(a.document, i, &def) == MXG_OK && !strcmp(def.name, "ND_probe"))
            REQUIRE(def.has_implementation);
    close_host(&a);
    close_host(&b);
}

static bool build_vertices(void *user_data, mxg_build *build, mxg_ref *results)
{
    mxg_build_info info = MXG_INIT(mxg_build_info);
    static const char *const names[] = {"p", "in"};
    const mxg_ref args[] = {mxg_build_stream(build, "positionObject", NULL),
                            mxg_build_input(build, "in")};
    bool *has_stage = user_data;
    mxg_build_use(build, &info);
    *has_stage = info.has_vertex_stage;
    mxg_ref wave = mxg_build_expression(build, "float", "sin({{p}}.x * {{in}})", names, args, 2);
    results[0] = mxg_build_interpolation(build, "wave", wave);
    return true;
}

static void test_vertices(void)
{
    for (uint32_t i = 0; i < mxg_catalogue_num_targets(); i++) {
        mxg_target target = MXG_INIT(mxg_target);
        struct host h;
        bool has_stage = false;
        mxg_catalogue_target(i, &target);
        open_host(&h, &(struct run){.build = build_vertices,
                                    .user_data = &has_stage,
                                    .of_target = target.name});
        REQUIRE_EQ(h.status, MXG_OK);
        REQUIRE_EQ(has_stage, strcmp(target.name, "osl") != 0 && strcmp(target.name, "mdl") != 0);
        REQUIRE_EQ(has_text(&h, MXG_STAGE_VERTEX, "sin("), has_stage);
        REQUIRE_EQ(has_text(&h, MXG_STAGE_PIXEL, "sin("), !has_stage);
        REQUIRE(!has_stage || !has_text(&h, MXG_STAGE_PIXEL, "positionObject"));
        close_host(&h);
    }
}

static bool build_skin(void *user_data, mxg_build *build, mxg_ref *results)
{
    static const char *const names[] = {"color"};
    mxg_ref layers[2];
    const mxg_ref color = mxg_build_input(build, "color");
    (void)user_data;
    if (!mxg_build_node(build, "ND_dielectric_bsdf", NULL, NULL, 0, &layers[0], 1)
        || !mxg_build_node(build, "ND_oren_nayar_diffuse_bsdf", names, &color, 1, &layers[1], 1))
        return false;
    mxg_ref under = mxg_build_input(build, "under");
    REQUIRE(!under); /* the closure is absent */
    layers[1] = mxg_build_op(build, "closure_add", NULL, (mxg_ref[]){layers[1], under}, 2);
    results[0] = mxg_build_op(build, "layer", NULL, layers, 2);
    return true;
}

static const char skin_body[] =
    "<skin name='s' type='BSDF'/><surface name='S' type='surfaceshader'>"
    "<input name='bsdf' type='BSDF' nodename='s'/></surface>"
    "<surfacematerial name='M' type='material'><input name='surfaceshader' type='surfaceshader' "
    "nodename='S'/></surfacematerial>";

static void test_closure(void)
{
    for (uint32_t i = 0; i < mxg_catalogue_num_targets(); i++) {
        mxg_target target = MXG_INIT(mxg_target);
        struct host h;
        mxg_catalogue_target(i, &target);
        open_host(&h, &(struct run){.build = build_skin,
                                    .name = "skin",
                                    .body = skin_body,
                                    .of_target = target.name});
        REQUIRE_EQ(h.status, MXG_OK);
        mxg_shader_info info = MXG_INIT(mxg_shader_info);
        REQUIRE_EQ(mxg_result_info(h.result, &info), MXG_OK);
        REQUIRE(strcmp(target.name, "osl") == 0 || info.num_closures == 2);
        close_host(&h);
    }
}

/* ---- Which code counts ---- */

static bool build_seven(void *user_data, mxg_build *build, mxg_ref *results)
{
    const float seven = 7.125f;
    (void)user_data;
    results[0] = mxg_build_number(build, "float", &seven, 1);
    return true;
}

static uint64_t topology_of(uint64_t version)
{
    struct host h;
    mxg_shader_info info = MXG_INIT(mxg_shader_info);
    open_host(&h, &(struct run){.build = build_seven, .version = version});
    REQUIRE_EQ(mxg_result_info(h.result, &info), MXG_OK);
    close_host(&h);
    return info.topology;
}

/* Applies the definition that it serves, which gives the implementation behind it. */
static bool build_around(void *user_data, mxg_build *build, mxg_ref *results)
{
    static const char *const names[] = {"in1", "in2"};
    const mxg_ref args[] = {mxg_build_input(build, "in1"), mxg_build_input(build, "in2")};
    const float hundred = 100.5f;
    mxg_ref inner;
    (void)user_data;
    if (!mxg_build_node(build, "ND_multiply_float", names, args, 2, &inner, 1))
        return false;
    mxg_ref sum[] = {inner, mxg_build_number(build, "float", &hundred, 1)};
    results[0] = mxg_build_op(build, "add", NULL, sum, 2);
    return true;
}

static void test_choice(void)
{
    struct host h;
    REQUIRE(topology_of(1) != topology_of(2));
    REQUIRE(topology_of(1) == topology_of(1));
    open_host(&h, &(struct run){.build = build_seven, .target = "genosl"});
    REQUIRE_EQ(h.status, MXG_ERROR_DOCUMENT);
    REQUIRE(has_diagnostic(mxg_result_diagnostics(h.result), "missing-implementation"));
    close_host(&h);
    open_host(&h, &(struct run){.build = build_seven, .target = "genglsl", .of_target = "essl"});
    REQUIRE(has_text(&h, MXG_STAGE_PIXEL, "7.125"));
    close_host(&h);
    static const char product[] = "<multiply name='use' type='float'>"
                                  "<input name='in1' type='float' value='3'/></multiply>"
                                  "<output name='M' type='float' nodename='use'/>";
    open_host(&h, &(struct run){.build = build_around,
                                .name = "ND_multiply_float",
                                .body = product,
                                .option = "interface",
                                .value = "reduced"});
    REQUIRE(has_text(&h, MXG_STAGE_PIXEL, "103.5"));
    close_host(&h);
    /* another definition stands in; its inputs of the same names get the values */
    open_host(&h, &(struct run){.instead = "ND_add_float",
                                .name = "ND_multiply_float",
                                .body = product,
                                .option = "interface",
                                .value = "reduced"});
    REQUIRE(has_text(&h, MXG_STAGE_PIXEL, "4.0"));
    close_host(&h);
}

/* ---- Code that misbehaves: an error of the document, or a fault of the code ---- */

static bool fail_at_input(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data, (void)results;
    mxg_build_report_error(build, "in", "100% of nothing: %s");
    REQUIRE_EQ(mxg_build_input(build, "in"), 0); /* after a failure nothing works */
    REQUIRE(!mxg_build_value(build, 1, NULL));
    return false;
}

static void test_error_at_input(void)
{
    struct host h;
    open_host(&h, &(struct run){.build = fail_at_input,
                                .body = "<probe name='use' type='float'>\n"
                                        " <input name='in' type='float' value='1'/></probe>"
                                        "<output name='M' type='float' nodename='use'/>"});
    mxg_diagnostic d = MXG_INIT(mxg_diagnostic);
    REQUIRE_EQ(h.status, MXG_ERROR_DOCUMENT);
    REQUIRE_EQ(mxg_diagnostics_num_errors(mxg_result_diagnostics(h.result)), 1);
    mxg_diagnostics_item(mxg_result_diagnostics(h.result), 0, &d);
    REQUIRE_STR(d.id, "code-error");
    REQUIRE_STR(d.message, "<probe>: 100% of nothing: %s");
    REQUIRE_STR(d.file, "code.mtlx");
    REQUIRE_EQ(d.line, 3);
    close_host(&h);
}

enum fault {
    FAULT_SILENT,
    FAULT_NO_RESULT,
    FAULT_OTHER_TYPE,
    FAULT_UNKNOWN_OP,
    FAULT_SOURCE_OP,
    FAULT_OPERANDS,
    FAULT_OPERAND_COUNT,
    FAULT_NO_OPERANDS,
    FAULT_UNKNOWN_INPUT,
    FAULT_UNKNOWN_TYPE,
    FAULT_UNKNOWN_STREAM,
    FAULT_UNKNOWN_NODE,
    FAULT_NODE_INPUT,
    FAULT_NODE_TYPE,
    FAULT_NODE_OUTPUTS,
    FAULT_COMPONENTS,
    FAULT_SWIZZLE,
    FAULT_NAN,
    FAULT_INTEGER,
    FAULT_FOREIGN_VALUE,
    FAULT_UNIFORM_TYPE,
    FAULT_UNIFORM_NAME,
    FAULT_UNIFORM_SIZE,
    FAULT_UNIFORM_DEFAULT,
    FAULT_BLOCK_NAME,
    FAULT_BLOCK_TAKEN,
    FAULT_BLOCK_OF_TEXTURE,
    FAULT_BLOCK_OF_OURS,
    FAULT_BLOCKS,
    FAULT_EXPRESSION_INPUT,
    FAULT_INTERPOLATED,
    FAULT_RECURSION,
    FAULT_NULL_TEXTS,
    NUM_FAULTS
};

static bool misuse_values(enum fault fault, mxg_build *build, mxg_ref in, mxg_ref *out)
{
    const float numbers[] = {1, 2, 3, 4}, huge = 1e20f;
    float nan_value;
    const uint32_t nan_bits = 0x7fc00000;
    memcpy(&nan_value, &nan_bits, sizeof nan_value);
    switch (fault) {
    case FAULT_UNKNOWN_OP: *out = mxg_build_op(build, "conjure", NULL, &in, 1); return true;
    case FAULT_SOURCE_OP: *out = mxg_build_op(build, "uniform", "float", &in, 1); return true;
    case FAULT_OPERANDS:
        *out = mxg_build_op(build, "cross", NULL, (mxg_ref[]){in, in}, 2);
        return true;
    case FAULT_OPERAND_COUNT: *out = mxg_build_op(build, "add", NULL, &in, 1); return true;
    case FAULT_NO_OPERANDS: *out = mxg_build_op(build, "construct", "vec3", NULL, 3); return true;
    case FAULT_UNKNOWN_INPUT: *out = mxg_build_input(build, "inn"); return true;
    case FAULT_UNKNOWN_TYPE: *out = mxg_build_number(build, "color3", numbers, 3); return true;
    case FAULT_COMPONENTS: *out = mxg_build_number(build, "vec3", numbers, 4); return true;
    case FAULT_SWIZZLE: *out = mxg_build_swizzle(build, in, "xy"); return true;
    case FAULT_NAN: *out = mxg_build_number(build, "float", &nan_value, 1); return true;
    case FAULT_INTEGER: *out = mxg_build_number(build, "int", &huge, 1); return true;
    case FAULT_UNKNOWN_STREAM: *out = mxg_build_stream(build, "moonlight", NULL); return true;
    case FAULT_INTERPOLATED:
        *out = mxg_build_interpolation(build, "w", mxg_build_string(build, "x"));
        return true;
    case FAULT_NULL_TEXTS: *out = mxg_build_op(build, NULL, NULL, NULL, 0); return true;
    default: return false;
    }
}

static bool misuse_shader(enum fault fault, mxg_build *build, mxg_ref in, mxg_ref *out)
{
    static const char *const in1[] = {"in1"}, *const other[] = {"other"};
    const float numbers[] = {1, 2};
    mxg_build_uniform uniform = {.size = sizeof uniform, .name = "u_mine", .type = "float"};
    mxg_ref two[2];
    switch (fault) {
    case FAULT_UNKNOWN_NODE: return mxg_build_node(build, "ND_none", NULL, NULL, 0, out, 1);
    case FAULT_NODE_INPUT: return mxg_build_node(build, "ND_add_float", other, &in, 1, out, 1);
    case FAULT_NODE_TYPE: return mxg_build_node(build, "ND_add_vector3", in1, &in, 1, out, 1);
    case FAULT_NODE_OUTPUTS: return mxg_build_node(build, "ND_add_float", in1, &in, 1, two, 2);
    case FAULT_EXPRESSION_INPUT:
        *out = mxg_build_expression(build, "float", "{{in1}}", in1, &(mxg_ref){0}, 1);
        return true;
    case FAULT_UNIFORM_TYPE: uniform.name = "u_worldMatrix"; break;
    case FAULT_UNIFORM_NAME: uniform.name = "gl_mine"; break;
    case FAULT_UNIFORM_SIZE: uniform.size = 1; break;
    case FAULT_BLOCK_NAME: uniform.block = "uniform"; break;
    case FAULT_BLOCK_TAKEN: uniform.block = "PublicUniforms"; break;
    case FAULT_BLOCK_OF_TEXTURE:
        uniform.block = "Frame";
        uniform.type = "sampler2D";
        break;
    case FAULT_BLOCK_OF_OURS:
        uniform.block = "Frame";
        uniform.name = "u_frame";
        break;
    case FAULT_BLOCKS:
        for (int i = 0; i < 5; i++)
            *out = mxg_build_add_uniform(
                build,
                &(mxg_build_uniform){.size = sizeof uniform,
                                     .name = "u_mine",
                                     .type = "float",
                                     .block = (const char *const[]){"A", "B", "C", "D", "E"}[i]});
        return true;
    default:
        uniform.values = numbers;
        uniform.num_values = 2;
        break;
    }
    *out = mxg_build_add_uniform(build, &uniform);
    return true;
}

static bool misuse(void *user_data, mxg_build *build, mxg_ref *results)
{
    enum fault fault = *(const enum fault *)user_data;
    static const char *const names[] = {"in"};
    if (fault == FAULT_SILENT)
        return false;
    mxg_ref in = mxg_build_input(build, "in");
    if (fault == FAULT_NO_RESULT)
        return true;
    if (fault == FAULT_OTHER_TYPE)
        results[0] = mxg_build_input(build, "tint");
    else if (fault == FAULT_FOREIGN_VALUE)
        results[0] = in + 1000;
    else if (fault == FAULT_RECURSION)
        return mxg_build_node(build, "ND_loop", names, &in, 1, results, 1);
    else if (!misuse_values(fault, build, in, &results[0]))
        return misuse_shader(fault, build, in, &results[0]);
    return true;
}

static void test_misuse(void)
{
    for (int i = 0; i < NUM_FAULTS; i++) {
        enum fault fault = (enum fault)i;
        struct host h;
        open_host(&h, &(struct run){.build = misuse, .user_data = &fault});
        bool is_told = has_diagnostic(mxg_result_diagnostics(h.result), "code-fault");
        if (h.status != MXG_ERROR_DOCUMENT || !is_told)
            printf("fault %d is not reported\n", i);
        REQUIRE_EQ(h.status, MXG_ERROR_DOCUMENT);
        REQUIRE(is_told);
        REQUIRE_EQ(mxg_diagnostics_num_errors(mxg_result_diagnostics(h.result)), 1);
        close_host(&h);
    }
}

/* An expression that does not parse has its errors at their places in the expression. */
static bool write_badly(void *user_data, mxg_build *build, mxg_ref *results)
{
    (void)user_data;
    results[0] = mxg_build_expression(build, "float", "1.0 +\n nothing", NULL, NULL, 0);
    return true;
}

/* A value that another call has made. */
static bool hand_over(void *user_data, mxg_build *build, mxg_ref *results)
{
    mxg_ref *kept = user_data;
    results[0] = *kept ? *kept : mxg_build_input(build, "in");
    *kept = results[0];
    return true;
}

static void test_wrong_texts_and_values(void)
{
    struct host h;
    mxg_diagnostic d = MXG_INIT(mxg_diagnostic);
    open_host(&h, &(struct run){.build = write_badly});
    REQUIRE_EQ(h.status, MXG_ERROR_DOCUMENT);
    mxg_diagnostics_item(mxg_result_diagnostics(h.result), 0, &d);
    REQUIRE_STR(d.file, "code of ND_probe");
    REQUIRE_EQ(d.line, 2);
    REQUIRE_EQ(d.column, 2);
    close_host(&h);
    mxg_ref kept = 0;
    open_host(&h,
              &(struct run){.build = hand_over,
                            .user_data = &kept,
                            .body = "<probe name='a' type='float'/>"
                                    "<probe name='b' type='float'><input name='in' type='float' "
                                    "nodename='a'/></probe>"
                                    "<output name='M' type='float' nodename='b'/>"});
    REQUIRE_EQ(h.status, MXG_ERROR_DOCUMENT);
    REQUIRE(has_diagnostic(mxg_result_diagnostics(h.result), "code-fault"));
    close_host(&h);
}

/* Builds without end, as long as the calls succeed. */
static bool build_endlessly(void *user_data, mxg_build *build, mxg_ref *results)
{
    mxg_ref sum = mxg_build_stream(build, "positionWorld", NULL);
    uint64_t *steps = user_data;
    for (float i = 1; sum; i += 1) {
        const float numbers[] = {i, i * 0.5f, 1};
        mxg_ref args[] = {sum, mxg_build_number(build, "vec3", numbers, 3)};
        sum = mxg_build_op(build, (*steps)++ & 1 ? "mul" : "max", NULL, args, 2);
    }
    results[0] = sum;
    return true;
}

static void test_limits(void)
{
    struct host h;
    uint64_t steps = 0;
    open_host(&h, &(struct run){.build = build_endlessly, .user_data = &steps, .max_nodes = 2000});
    REQUIRE_EQ(h.status, MXG_ERROR_DOCUMENT);
    REQUIRE(has_diagnostic(mxg_result_diagnostics(h.result), "node-limit"));
    close_host(&h);
    open_host(&h,
              &(struct run){.build = build_endlessly, .user_data = &steps, .max_memory = 6 << 20});
    REQUIRE_EQ(h.status, MXG_ERROR_MEMORY);
    REQUIRE(h.result == NULL);
    close_host(&h);
    REQUIRE(steps > 1000);
}

static void refuse(mxg_node_code code)
{
    const mxg_node_code *const codes[] = {&code};
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    mxg_context *context = NULL;
    desc.node_codes = codes;
    desc.num_node_codes = 1;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_ERROR_ARGUMENT);
    REQUIRE(!context);
}

static void test_descriptions(void)
{
    mxg_node_code good = {sizeof good, "ND_x", NULL, 0, build_seven, NULL, NULL}, bad = good;
    bad.size = 3;
    refuse(bad);
    bad = good;
    bad.name = NULL;
    refuse(bad);
    bad = good;
    bad.build = NULL;
    refuse(bad);
    bad = good;
    bad.instead = "ND_y";
    refuse(bad);
    bad = good;
    bad.target = "genmoon";
    refuse(bad);
    mxg_context_desc desc = MXG_CONTEXT_DESC_INIT;
    mxg_context *context = NULL;
    desc.num_node_codes = 1;
    REQUIRE_EQ(mxg_context_create(&desc, &context), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_build_input(NULL, "in"), 0);
    REQUIRE(mxg_build_type(NULL, 1) == NULL);
    mxg_build_report_error(NULL, NULL, NULL);
}

int main(void)
{
    test_values();
    test_own_blocks();
    test_same_as_library();
    test_vertices();
    test_closure();
    test_choice();
    test_error_at_input();
    test_misuse();
    test_wrong_texts_and_values();
    test_limits();
    test_descriptions();
    return test_report("api-code");
}
