// SPDX-License-Identifier: Apache-2.0
/* Hosts that keep a program: the states of inputs, the effect of edits, blocks ready for upload. */
#include "fixture.h"

static const char document_text[] =
    "<materialx version='1.39'>"
    "<nodedef name='ND_half' node='half'><input name='in' type='float' value='1'/>"
    "<output name='out' type='float'/></nodedef>"
    "<nodegraph name='NG_half' nodedef='ND_half'>"
    "<multiply name='m' type='float'><input name='in1' type='float' interfacename='in'/>"
    "<input name='in2' type='float' value='0.5'/></multiply>"
    "<output name='out' type='float' nodename='m'/></nodegraph>"
    "<nodegraph name='G'>"
    "<input name='scale' type='float' value='2' uiname='Scale'/>"
    "<input name='idle' type='float' value='3'/>"
    "<tiledimage name='wood' type='color3'><input name='file' type='filename' value='wood.png'/>"
    "<input name='uvtiling' type='vector2' value='4, 4'/></tiledimage>"
    "<worleynoise2d name='cells' type='float'><input name='jitter' type='float' value='0.5'/>"
    "</worleynoise2d>"
    "<half name='h1' type='float'><input name='in' type='float' nodename='cells'/></half>"
    "<half name='h2' type='float'><input name='in' type='float' nodename='h1'/></half>"
    "<multiply name='rough' type='float'><input name='in1' type='float' nodename='h2'/>"
    "<input name='in2' type='float' interfacename='scale'/></multiply>"
    "<noise2d name='loose' type='float'/>"
    "<output name='color' type='color3' nodename='wood'/>"
    "<output name='worn' type='float' nodename='rough'/></nodegraph>"
    "<standard_surface name='S' type='surfaceshader'>"
    "<input name='base_color' type='color3' nodegraph='G' output='color'/>"
    "<input name='specular_roughness' type='float' nodegraph='G' output='worn'/>"
    "<input name='metalness' type='float' value='0.25'/>"
    "</standard_surface>"
    "<surfacematerial name='M' type='material'><input name='surfaceshader' type='surfaceshader' "
    "nodename='S'/></surfacematerial></materialx>";

struct host {
    mxg_context *context;
    mxg_library *library;
    mxg_document *document;
    mxg_options *options;
};

static void open_host(struct host *h, const char *text)
{
    memset(h, 0, sizeof *h);
    REQUIRE_EQ(mxg_context_create(NULL, &h->context), MXG_OK);
    h->library = mxg_library_builtin(h->context);
    REQUIRE_EQ(
        mxg_document_parse(h->context, h->library, "host.mtlx", text, strlen(text), &h->document),
        MXG_OK);
    REQUIRE_EQ(mxg_options_create(h->context, &h->options), MXG_OK);
}

static void close_host(struct host *h)
{
    mxg_options_destroy(h->options);
    mxg_document_destroy(h->document);
    mxg_library_unref(h->library);
    mxg_context_destroy(h->context);
}

static mxg_result *generate(const struct host *h, const mxg_document *document, const char *target,
                            bool without_source)
{
    mxg_generate_desc desc = MXG_GENERATE_DESC_INIT;
    desc.target = target;
    desc.element = "M";
    desc.options = h->options;
    desc.without_source = without_source;
    mxg_result *result = NULL;
    REQUIRE_EQ(mxg_generate(h->context, document, &desc, &result), MXG_OK);
    return result;
}

/* ---- States of inputs ---- */

static const struct state {
    const char *path;
    mxg_input_state state, reduced; /* with the interface `complete`, and `reduced` */
} states[] = {
    {"S/metalness", MXG_INPUT_UNIFORM, MXG_INPUT_COMPILED},
    {"/S/metalness", MXG_INPUT_UNIFORM, MXG_INPUT_COMPILED},
    {"S/coat", MXG_INPUT_UNIFORM, MXG_INPUT_COMPILED}, /* not in the document */
    {"S/base_color", MXG_INPUT_CONNECTED, MXG_INPUT_CONNECTED},
    {"S/normal", MXG_INPUT_CONNECTED, MXG_INPUT_CONNECTED}, /* to the geometry */
    {"S/baze", MXG_INPUT_UNKNOWN, MXG_INPUT_UNKNOWN},
    {"G/scale", MXG_INPUT_UNIFORM, MXG_INPUT_COMPILED},
    {"G/idle", MXG_INPUT_UNUSED, MXG_INPUT_UNUSED},
    {"G/wood/file", MXG_INPUT_UNIFORM, MXG_INPUT_UNIFORM},
    {"G/wood/uvtiling", MXG_INPUT_COMPILED, MXG_INPUT_COMPILED},
    {"G/wood/filtertype", MXG_INPUT_COMPILED, MXG_INPUT_COMPILED},
    {"G/wood/texcoord", MXG_INPUT_CONNECTED, MXG_INPUT_CONNECTED},
    {"G/cells/jitter", MXG_INPUT_COMPILED, MXG_INPUT_COMPILED},
    {"G/cells/style", MXG_INPUT_COMPILED, MXG_INPUT_COMPILED},
    {"G/rough/in2", MXG_INPUT_CONNECTED, MXG_INPUT_CONNECTED},
    {"G/loose/amplitude", MXG_INPUT_UNUSED, MXG_INPUT_UNUSED},
    {"G/loose/amplitud", MXG_INPUT_UNKNOWN, MXG_INPUT_UNKNOWN},
    {"NG_half/m/in1", MXG_INPUT_CONNECTED, MXG_INPUT_CONNECTED},
    {"NG_half/m/in2", MXG_INPUT_COMPILED, MXG_INPUT_COMPILED},
    {"M", MXG_INPUT_UNKNOWN, MXG_INPUT_UNKNOWN},
    {"G/color", MXG_INPUT_UNKNOWN, MXG_INPUT_UNKNOWN}, /* an output */
    {"S/", MXG_INPUT_UNKNOWN, MXG_INPUT_UNKNOWN},
    {"", MXG_INPUT_UNKNOWN, MXG_INPUT_UNKNOWN},
};

static void check_states(const mxg_result *result, bool is_reduced)
{
    for (size_t i = 0; i < sizeof states / sizeof *states; i++) {
        mxg_input_state wanted = is_reduced ? states[i].reduced : states[i].state;
        if (!REQUIRE_EQ(mxg_result_input_state(result, states[i].path), wanted))
            printf("at %s\n", states[i].path);
        REQUIRE_EQ(mxg_result_find_variable(result, states[i].path + (*states[i].path == '/'))
                       != MXG_NONE,
                   wanted == MXG_INPUT_UNIFORM);
    }
}

static void test_states(void)
{
    struct host h;
    open_host(&h, document_text);
    mxg_result *result = generate(&h, h.document, "glsl", false);
    check_states(result, false);
    REQUIRE_EQ(mxg_result_input_state(NULL, "S/coat"), MXG_INPUT_UNKNOWN);
    REQUIRE_EQ(mxg_result_input_state(result, NULL), MXG_INPUT_UNKNOWN);
    mxg_result_destroy(result);
    mxg_options_set(h.options, "interface", "reduced");
    result = generate(&h, h.document, "glsl", true);
    check_states(result, true);
    mxg_result_destroy(result);
    close_host(&h);
}

static bool find_compiled(const mxg_result *result, const char *path, mxg_compiled_input *out)
{
    unsigned found = 0;
    for (uint32_t i = 0; i < mxg_result_num_compiled_inputs(result); i++) {
        mxg_compiled_input input = MXG_INIT(mxg_compiled_input);
        REQUIRE_EQ(mxg_result_compiled_input(result, i, &input), MXG_OK);
        if (strcmp(input.path, path) != 0)
            continue;
        *out = input;
        found++;
    }
    REQUIRE(found <= 1); /* also inside a definition that two nodes use */
    return found == 1;
}

static void test_compiled_inputs(void)
{
    struct host h;
    open_host(&h, document_text);
    mxg_result *result = generate(&h, h.document, "glsl", true);
    mxg_compiled_input input = {0};
    REQUIRE(find_compiled(result, "G/wood/uvtiling", &input));
    REQUIRE_STR(input.type, "vector2");
    REQUIRE_STR(input.value, "4, 4");
    REQUIRE(input.authored);
    REQUIRE(find_compiled(result, "G/cells/jitter", &input));
    REQUIRE_STR(input.value, "0.5");
    REQUIRE(find_compiled(result, "NG_half/m/in2", &input));
    REQUIRE(find_compiled(result, "G/wood/filtertype", &input));
    REQUIRE_STR(input.value, "linear");
    REQUIRE_STR(input.enum_names, "closest,linear,cubic");
    REQUIRE(!input.authored);
    REQUIRE(!find_compiled(result, "S/metalness", &input));
    const char *json = mxg_result_reflection_json(result, NULL);
    REQUIRE(json
            && strstr(json, "\"path\": \"G/cells/jitter\",\n      \"documentType\": \"float\",\n"
                            "      \"value\": \"0.5\",\n      \"authored\": true"));
    mxg_result_destroy(result);
    mxg_options_set(h.options, "constant", "S/coat,G/scale");
    result = generate(&h, h.document, "glsl", true);
    REQUIRE(find_compiled(result, "S/coat", &input));
    REQUIRE_STR(input.uiname, "Coat");
    REQUIRE_STR(input.uifolder, "Coat");
    REQUIRE_STR(input.uimax, "1.0");
    REQUIRE(find_compiled(result, "G/scale", &input));
    REQUIRE_STR(input.uiname, "Scale");
    mxg_result_destroy(result);
    close_host(&h);
}

/* The number of the property decides about the code, so the uniform alone would do nothing. */
static void test_deciding_uniform(void)
{
    struct host h;
    open_host(&h, "<materialx version='1.39'><nodegraph name='G'>"
                  "<input name='set' type='integer' value='1'/>"
                  "<texcoord name='uv' type='vector3'><input name='index' type='integer' "
                  "interfacename='set'/></texcoord>"
                  "<convert name='c' type='color3'><input name='in' type='vector3' nodename='uv'/>"
                  "</convert><output name='out' type='color3' nodename='c'/></nodegraph>"
                  "<standard_surface name='S' type='surfaceshader'><input name='base_color' "
                  "type='color3' nodegraph='G'/></standard_surface>"
                  "<surfacematerial name='M' type='material'><input name='surfaceshader' "
                  "type='surfaceshader' nodename='S'/></surfacematerial></materialx>");
    mxg_result *result = generate(&h, h.document, "glsl", true);
    mxg_compiled_input input = {0};
    REQUIRE_EQ(mxg_result_input_state(result, "G/set"), MXG_INPUT_COMPILED);
    REQUIRE(find_compiled(result, "G/set", &input));
    REQUIRE_STR(input.value, "1");
    mxg_result_destroy(result);
    close_host(&h);
}

/* ---- Changes ---- */

/* The change from the document to one in which an input has another value. */
static mxg_change change_of(struct host *h, const char *node, const char *input, const char *type,
                            const char *value, uint32_t *out_variable, uint32_t *out_num)
{
    mxg_edit *edit = NULL;
    mxg_document *next = NULL;
    REQUIRE_EQ(mxg_edit_create(h->context, h->library, h->document, NULL, &edit), MXG_OK);
    REQUIRE_EQ(mxg_edit_set_value(edit, edited_at(edit, node), input, type, value), MXG_OK);
    REQUIRE_EQ(commit(edit, &next), MXG_OK);
    mxg_result *before = generate(h, h->document, "glsl", false),
               *after = generate(h, next, "glsl", true);
    mxg_change change = mxg_result_change(before, after, out_variable, 1, out_num);
    mxg_result_destroy(before);
    mxg_result_destroy(after);
    mxg_document_destroy(next);
    return change;
}

static void test_changes(void)
{
    struct host h;
    open_host(&h, document_text);
    mxg_result *program = generate(&h, h.document, "glsl", false);
    uint32_t variable = UINT32_MAX, wanted = 0, num = 7;
    REQUIRE_EQ(change_of(&h, "S", "metalness", "float", "0.25", &variable, &num),
               MXG_CHANGE_NOTHING);
    REQUIRE_EQ(num, 0);
    REQUIRE_EQ(change_of(&h, "S", "metalness", "float", "0.75", &variable, &num),
               MXG_CHANGE_VALUES);
    REQUIRE((wanted = mxg_result_find_variable(program, "S/metalness")) != MXG_NONE);
    REQUIRE_EQ(variable, wanted);
    REQUIRE_EQ(num, 1);
    REQUIRE_EQ(change_of(&h, "G/wood", "file", "filename", "oak.png", &variable, &num),
               MXG_CHANGE_VALUES);
    REQUIRE((wanted = mxg_result_find_variable(program, "G/wood/file")) != MXG_NONE);
    REQUIRE_EQ(variable, wanted);
    REQUIRE_EQ(change_of(&h, "G/wood", "filtertype", "string", "closest", &variable, &num),
               MXG_CHANGE_VALUES);
    REQUIRE_EQ(variable, wanted);
    REQUIRE_EQ(change_of(&h, "G/wood", "uvtiling", "vector2", "5, 5", &variable, &num),
               MXG_CHANGE_SHADER);
    REQUIRE_EQ(num, 0);
    REQUIRE_EQ(change_of(&h, "G/cells", "jitter", "float", "0.75", NULL, NULL), MXG_CHANGE_SHADER);
    REQUIRE_EQ(change_of(&h, "G/loose", "amplitude", "float", "9", NULL, NULL), MXG_CHANGE_NOTHING);
    /* other options or targets are other programs, and so is a result without one */
    mxg_result *other = generate(&h, h.document, "vulkan", true);
    REQUIRE_EQ(mxg_result_change(program, other, NULL, 0, NULL), MXG_CHANGE_SHADER);
    mxg_result_destroy(other);
    mxg_options_set(h.options, "max-lights", "4");
    other = generate(&h, h.document, "glsl", true);
    REQUIRE_EQ(mxg_result_change(program, other, NULL, 0, NULL), MXG_CHANGE_SHADER);
    REQUIRE_EQ(mxg_result_change(other, other, NULL, 0, NULL), MXG_CHANGE_NOTHING);
    REQUIRE_EQ(mxg_result_change(program, NULL, NULL, 0, NULL), MXG_CHANGE_SHADER);
    mxg_result_destroy(other);
    mxg_result_destroy(program);
    close_host(&h);
}

/* ---- Blocks ---- */

static float float_at(const unsigned char *bytes, uint32_t offset)
{
    float value;
    memcpy(&value, bytes + offset, sizeof value);
    return value;
}

/* The bytes of every variable with a default, read by the places that the variables say. */
static void check_bytes(const mxg_result *result, const mxg_block_info *block,
                        const unsigned char *bytes)
{
    uint32_t end = 0;
    for (uint32_t i = 0; i < block->num_variables; i++) {
        mxg_variable v = MXG_INIT(mxg_variable);
        REQUIRE_EQ(mxg_result_variable(result, block->first_variable + i, &v), MXG_OK);
        REQUIRE(v.offset >= end && v.offset + v.byte_size <= block->byte_size);
        for (; end < v.offset; end++)
            REQUIRE_EQ(bytes[end], 0);
        end = v.offset + v.byte_size;
        bool is_whole = strcmp(v.document_type, "integer") == 0
                        || strcmp(v.document_type, "boolean") == 0 || strcmp(v.type, "int") == 0
                        || strcmp(v.type, "bool") == 0;
        uint32_t rows = v.matrix_stride ? v.byte_size / v.matrix_stride : v.num_values;
        for (uint32_t n = 0; n < v.num_values; n++) {
            uint32_t at = v.offset + n / rows * v.matrix_stride + n % rows * 4;
            int32_t whole;
            memcpy(&whole, bytes + at, sizeof whole);
            REQUIRE(is_whole ? (float)whole == v.values[n] : float_at(bytes, at) == v.values[n]);
        }
    }
}

static void test_pack(const char *target)
{
    struct host h;
    open_host(&h, document_text);
    mxg_result *result = generate(&h, h.document, target, true);
    for (int b = MXG_BLOCK_PUBLIC_UNIFORMS; b <= MXG_BLOCK_PRIVATE_UNIFORMS; b++) {
        mxg_block_info block = MXG_INIT(mxg_block_info);
        REQUIRE_EQ(mxg_result_block(result, (mxg_block)b, &block), MXG_OK);
        REQUIRE(block.byte_size > 0 && block.byte_size % 16 == 0 && block.num_variables > 0);
        REQUIRE_EQ(block.binding, b == MXG_BLOCK_PUBLIC_UNIFORMS ? 1 : 0);
        unsigned char *bytes = malloc(block.byte_size);
        memset(bytes, 0xAB, block.byte_size);
        REQUIRE_EQ(mxg_result_pack_block(result, NULL, (mxg_block)b, bytes, block.byte_size - 1),
                   MXG_ERROR_ARGUMENT);
        REQUIRE_EQ(bytes[0], 0xAB);
        REQUIRE_EQ(mxg_result_pack_block(result, NULL, (mxg_block)b, bytes, block.byte_size),
                   MXG_OK);
        check_bytes(result, &block, bytes);
        free(bytes);
    }
    unsigned char byte = 0;
    REQUIRE_EQ(mxg_result_pack_block(result, NULL, MXG_BLOCK_TEXTURES, &byte, 1),
               MXG_ERROR_ARGUMENT);
    mxg_result_destroy(result);
    close_host(&h);
}

static void test_pack_values(void)
{
    struct host h;
    open_host(&h, document_text);
    mxg_result *result = generate(&h, h.document, "vulkan", true);
    mxg_variable v = MXG_INIT(mxg_variable);
    unsigned char bytes[4096];
    uint32_t index;
    const float one = 0.75f, matrix[16] = {[4] = 5, [15] = 7};
    mxg_block_info block = MXG_INIT(mxg_block_info);
    REQUIRE_EQ(mxg_result_block(result, MXG_BLOCK_PUBLIC_UNIFORMS, &block), MXG_OK);
    size_t size = block.byte_size;
    REQUIRE(size > 0 && size <= sizeof bytes);
    REQUIRE_EQ(mxg_result_pack_block(result, NULL, MXG_BLOCK_PUBLIC_UNIFORMS, bytes, size), MXG_OK);
    REQUIRE((index = mxg_result_find_variable(result, "S/metalness")) != MXG_NONE);
    REQUIRE_EQ(mxg_result_pack_value(result, index, 0, &one, 1, bytes, size), MXG_OK);
    REQUIRE_EQ(mxg_result_variable(result, index, &v), MXG_OK);
    REQUIRE(float_at(bytes, v.offset) == 0.75f);
    REQUIRE_EQ(mxg_result_pack_value(result, index, 1, &one, 1, bytes, size), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_result_pack_value(result, index, 0, matrix, 3, bytes, size), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_result_pack_value(result, index, 0, &one, 1, bytes, 4), MXG_ERROR_ARGUMENT);
    REQUIRE_EQ(mxg_result_pack_value(result, UINT32_MAX, 0, &one, 1, bytes, size),
               MXG_ERROR_ARGUMENT);
    REQUIRE((index = mxg_result_find_variable(result, "S/thin_walled")) != MXG_NONE);
    REQUIRE_EQ(mxg_result_pack_value(result, index, 0, &one, 1, bytes, size), MXG_OK);
    REQUIRE_EQ(mxg_result_variable(result, index, &v), MXG_OK);
    const unsigned char is_true[4] = {1};
    REQUIRE(memcmp(bytes + v.offset, is_true, sizeof is_true) == 0);
    REQUIRE_EQ(mxg_result_block(result, MXG_BLOCK_PRIVATE_UNIFORMS, &block), MXG_OK);
    unsigned matrices = 0;
    for (uint32_t i = block.first_variable; i < block.first_variable + block.num_variables; i++) {
        REQUIRE_EQ(mxg_result_variable(result, i, &v), MXG_OK);
        if (strcmp(v.type, "mat4") != 0)
            continue;
        matrices++;
        REQUIRE_EQ(mxg_result_pack_value(result, i, 0, matrix, 16, bytes, sizeof bytes), MXG_OK);
        REQUIRE(float_at(bytes, v.offset + 16) == 5 && float_at(bytes, v.offset + 60) == 7);
    }
    REQUIRE(matrices > 0);
    mxg_result_destroy(result);
    close_host(&h);
}

static void test_lights(void)
{
    struct host h;
    open_host(&h, document_text);
    mxg_result *result = generate(&h, h.document, "vulkan", true);
    mxg_block_info block = MXG_INIT(mxg_block_info);
    mxg_light_type light = MXG_INIT(mxg_light_type);
    REQUIRE_EQ(mxg_result_block(result, MXG_BLOCK_LIGHT_DATA, &block), MXG_OK);
    REQUIRE_EQ(block.array_length, 3);
    REQUIRE_EQ(block.byte_size, 3 * block.array_stride);
    REQUIRE_EQ(mxg_result_num_light_types(result), 3);
    REQUIRE_EQ(mxg_result_light_type(result, 0, &light), MXG_OK);
    REQUIRE_EQ(light.type, 1);
    REQUIRE(!light.is_shader);
    REQUIRE_STR(light.name, "mx_directional_light");
    static const char *const members[] = {"direction", "color", "intensity"};
    REQUIRE_EQ(light.num_members, 3);
    unsigned char *bytes = malloc(block.byte_size);
    REQUIRE_EQ(mxg_result_pack_block(result, NULL, MXG_BLOCK_LIGHT_DATA, bytes, block.byte_size),
               MXG_OK);
    for (uint32_t m = 0; m < light.num_members; m++) {
        mxg_variable v = MXG_INIT(mxg_variable);
        uint32_t variable;
        REQUIRE((variable = mxg_result_light_member(result, 0, m)) != MXG_NONE);
        REQUIRE_EQ(mxg_result_variable(result, variable, &v), MXG_OK);
        REQUIRE_STR(v.name, members[m]);
        const float down[3] = {0, -1, 0.5f};
        if (m)
            continue;
        REQUIRE_EQ(mxg_result_pack_value(result, variable, 2, down, 3, bytes, block.byte_size),
                   MXG_OK);
        REQUIRE(float_at(bytes, 2 * block.array_stride + v.offset + 4) == -1);
        REQUIRE_EQ(mxg_result_pack_value(result, variable, 3, down, 3, bytes, block.byte_size),
                   MXG_ERROR_ARGUMENT);
    }
    free(bytes);
    REQUIRE_EQ(mxg_result_light_member(result, 0, 3), MXG_NONE);
    REQUIRE_EQ(mxg_result_light_type(result, 3, &light), MXG_ERROR_ARGUMENT);
    mxg_result_destroy(result);
    /* single uniforms: the block has members, but no buffer */
    result = generate(&h, h.document, "glsl", true);
    REQUIRE_EQ(mxg_result_block(result, MXG_BLOCK_PUBLIC_UNIFORMS, &block), MXG_OK);
    REQUIRE(block.byte_size == 0 && block.num_variables > 10);
    REQUIRE_EQ(mxg_result_block(result, MXG_NUM_BLOCKS, &block), MXG_ERROR_ARGUMENT);
    mxg_result_destroy(result);
    close_host(&h);
}

/* ---- Semantics ---- */

/* A '*' stands for one or more characters. */
static bool fits(const char *pattern, const char *text)
{
    const char *star = strchr(pattern, '*');
    if (!star)
        return strcmp(pattern, text) == 0;
    size_t head = (size_t)(star - pattern), tail = strlen(star + 1), len = strlen(text);
    return len > head + tail && strncmp(pattern, text, head) == 0
           && strcmp(star + 1, text + len - tail) == 0;
}

/* Every variable that the host supplies has a meaning, in its block and with its type. */
static void check_semantics(const mxg_result *result)
{
    for (uint32_t i = 0; i < mxg_result_num_variables(result); i++) {
        mxg_variable v = MXG_INIT(mxg_variable);
        REQUIRE_EQ(mxg_result_variable(result, i, &v), MXG_OK);
        if (*v.path || v.block == MXG_BLOCK_OUTPUTS)
            continue;
        const char *name = v.block == MXG_BLOCK_LIGHT_DATA ? v.name : v.semantic;
        bool found = false;
        for (uint32_t s = 0; s < mxg_catalogue_num_semantics(); s++) {
            mxg_semantic semantic = MXG_INIT(mxg_semantic);
            REQUIRE_EQ(mxg_catalogue_semantic(s, &semantic), MXG_OK);
            bool is_stream = v.block == MXG_BLOCK_VERTEX_DATA;
            found |= fits(semantic.semantic, name) && (semantic.block == v.block || is_stream)
                     && (!*semantic.type || strcmp(semantic.type, v.type) == 0);
        }
        if (!REQUIRE(found))
            printf("no meaning of '%s'\n", name);
    }
}

static void test_semantics(void)
{
    struct host h;
    open_host(&h, document_text);
    mxg_result *result = generate(&h, h.document, "vulkan", true);
    check_semantics(result);
    mxg_result_destroy(result);
    mxg_options_set(h.options, "role", "scatter");
    result = generate(&h, h.document, "vulkan", true);
    check_semantics(result);
    mxg_result_destroy(result);
    mxg_semantic semantic = MXG_INIT(mxg_semantic);
    REQUIRE_EQ(mxg_catalogue_semantic(mxg_catalogue_num_semantics(), &semantic),
               MXG_ERROR_ARGUMENT);
    close_host(&h);
}

/* A host finds the name of the function that it calls in both forms of the reflection. */
static void test_functions(void)
{
    static const char *const targets[] = {"glsl", "vulkan", "essl", "essl310",
                                          "hlsl", "slang",  "msl",  "wgsl"};
    static const char *const roles[][2] = {
        {"raster", ""}, {"function", "my_surface"}, {"scatter", "my_scatter"}};
    struct host h;
    open_host(&h, document_text);
    mxg_options_set(h.options, "prefix", "my_");
    for (size_t t = 0; t < sizeof targets / sizeof *targets; t++)
        for (size_t r = 0; r < sizeof roles / sizeof *roles; r++) {
            char call[64], member[64];
            const char *name = roles[r][1];
            mxg_options_set(h.options, "role", roles[r][0]);
            mxg_result *result = generate(&h, h.document, targets[t], false);
            mxg_shader_info info = MXG_INIT(mxg_shader_info);
            REQUIRE_EQ(mxg_result_info(result, &info), MXG_OK);
            REQUIRE_STR(info.function, name);
            snprintf(call, sizeof call, "%s(", name);
            snprintf(member, sizeof member, "\"function\": \"%s\"", name);
            REQUIRE(strstr(mxg_result_source(result, MXG_STAGE_PIXEL, NULL), call));
            REQUIRE((strstr(mxg_result_reflection_json(result, NULL), member) != NULL)
                    == (*name != 0));
            mxg_result_destroy(result);
        }
    close_host(&h);
}

int main(void)
{
    test_functions();
    test_states();
    test_compiled_inputs();
    test_deciding_uniform();
    test_changes();
    test_pack("vulkan");
    test_pack("hlsl");
    test_pack_values();
    test_lights();
    test_semantics();
    return test_report("api-embed");
}
