// SPDX-License-Identifier: Apache-2.0
/*
 * Metadata of parameters:
 *
 *     #define UNIT float min = 0, float max = 1
 *
 *     float metalness = 0.0 [[ string page = "Base", UNIT ]]
 */
#include "generators/osl/osl.h"

static const char *text_of(const struct osl *osl, str_id id)
{
    return str_text(osl->spell->shader->strings, id);
}

/* Starts a piece of metadata with "[[ " or ", ". */
static void write_piece(struct spell *spell, const char *piece, unsigned *count)
{
    SPELL(spell, (*count)++ ? ", " : " [[ ", piece);
}

/* "string page = "Base"", or "" if the value is empty. */
static const char *hint_text(const struct spell *spell, const char *name, const char *text)
{
    struct text piece;
    text_init(&piece, spell->scratch);
    if (text && *text) {
        text_fmt(&piece, "string %s = ", name);
        text_json_string(&piece, text, strlen(text));
    }
    return text_cstr(&piece);
}

static void write_hint(struct spell *spell, const char *name, const char *text, unsigned *count)
{
    if (text && *text)
        write_piece(spell, hint_text(spell, name, text), count);
}

/* ---- Ranges ---- */

static const char *first_of(const char *a, const char *b)
{
    return a && *a ? a : b;
}

static void add_limit(struct text *piece, const char *name, const char *limit, ir_type_id type)
{
    if (!limit || !*limit)
        return;
    text_fmt(piece, "%s%s %s = ", piece->len ? ", " : "", type == IR_TYPE_INT ? "int" : "float",
             name);
    size_t len = strlen(limit);
    while (strchr(limit, '.') && len > 1 && (limit[len - 1] == '0' || limit[len - 1] == '.')
           && limit[len - 2] != '-')
        if (limit[--len] == '.') /* "1.0" is 1 */
            break;
    text_mem(piece, limit, len);
}

/* "float min = 0, float max = 1", or "" without limits. */
static const char *range_text(const struct spell *spell, const struct shader_variable *variable,
                              const struct shader_ui *ui)
{
    struct text piece;
    text_init(&piece, spell->scratch);
    if (variable->type == IR_TYPE_FLOAT || variable->type == IR_TYPE_INT) {
        add_limit(&piece, "min", first_of(ui->uisoftmin, ui->uimin), variable->type);
        add_limit(&piece, "max", first_of(ui->uisoftmax, ui->uimax), variable->type);
    }
    return text_cstr(&piece);
}

/* ---- Metadata that many parameters share ---- */

static struct osl_macro *find_macro(struct osl *osl, const char *text)
{
    for (uint32_t i = 0; i < osl->macros.len; i++)
        if (strcmp(osl->macros.items[i].text, text) == 0)
            return &osl->macros.items[i];
    return NULL;
}

static void count_piece(struct osl *osl, const char *text, const char *name)
{
    if (!*text)
        return;
    struct osl_macro *macro = find_macro(osl, text);
    if (macro)
        macro->uses++;
    else
        vec_push(osl->spell->scratch, &osl->macros, (struct osl_macro){text, name, 1});
}

/* "THIN_FILM" for the page "Thin Film". */
static const char *page_name(const struct spell *spell, const char *page)
{
    size_t len;
    char *name = arena_strndup(spell->scratch, page, strlen(page));
    for (char *c = name; *c; c++)
        *c = *c >= 'a' && *c <= 'z' ? (char)(*c & ~0x20) : *c;
    return identifier_from(name, strlen(name), spell->scratch, &len);
}

static void find_ui(const struct spell *spell, const struct shader_variable *variable,
                    struct shader_ui *ui)
{
    *ui = (struct shader_ui){0};
    if (spell->options->ui)
        spell->options->ui(spell->options->user_data, variable, ui);
}

static bool is_parameter(const struct osl *osl, const struct shader_variable *variable)
{
    return (variable->block == BLOCK_PUBLIC_UNIFORMS || variable->block == BLOCK_TEXTURES)
           && osl_is_read(osl, variable);
}

enum { MIN_USES = 3 }; /* with fewer uses, the definition is longer than the text that it saves */

static bool is_worth_it(const struct osl_macro *macro)
{
    size_t text = strlen(macro->text), name = strlen(macro->name);
    return macro->uses >= MIN_USES
           && macro->uses * text > macro->uses * name + strlen("#define  \n") + name + text;
}

/* Pages and ranges that many parameters share become macros above the shader. */
void osl_write_macros(struct osl *osl)
{
    struct spell *spell = osl->spell;
    struct shader_ui ui;
    for (uint32_t i = 0; spell->options->metadata && i < spell->shader->interface.used.len; i++) {
        const struct shader_variable *variable = spell_interface_variable(osl->spell, i);
        if (!is_parameter(osl, variable))
            continue;
        find_ui(spell, variable, &ui);
        count_piece(osl, hint_text(spell, "page", ui.uifolder),
                    page_name(spell, ui.uifolder ? ui.uifolder : ""));
        const char *range = range_text(spell, variable, &ui);
        count_piece(osl, range,
                    strcmp(range, "float min = 0, float max = 1") == 0 ? "UNIT" : "RANGE");
    }
    uint32_t kept = 0;
    for (uint32_t i = 0; i < osl->macros.len; i++) {
        struct osl_macro macro = osl->macros.items[i];
        if (!is_worth_it(&macro))
            continue;
        macro.name = names_unique(&spell->names, macro.name, strlen(macro.name)).text;
        SPELL(spell, "#define ", macro.name, " ", macro.text, "\n");
        osl->macros.items[kept++] = macro;
    }
    osl->macros.len = kept;
    if (kept)
        spell_text(spell, "\n");
}

static void write_shared(struct osl *osl, const char *text, unsigned *count)
{
    const struct osl_macro *macro = *text ? find_macro(osl, text) : NULL;
    if (*text)
        write_piece(osl->spell, macro ? macro->name : text, count);
}

/* ---- The rest ---- */

/*
 * True for a label that repeats the name, such as "Base Color" for base_color: user interfaces
 * derive it from the name. An underscore after a keyword does not count.
 */
static bool repeats_name(const char *label, const char *name)
{
    for (; *label && *name; label++, name++)
        if ((*label == ' ' ? '_' : *label | 0x20) != (*name == '_' ? '_' : *name | 0x20))
            return false;
    return !*label && (!*name || strcmp(name, "_") == 0);
}

static void write_label(struct spell *spell, const char *name, const char *label, unsigned *count)
{
    if (label && !repeats_name(label, name))
        write_hint(spell, "label", label, count);
}

/* The colour space of colours and images; NULL for the working space. */
static const char *colorspace_of(const struct osl *osl, const struct shader_variable *variable)
{
    const char *space = text_of(osl, variable->colorspace);
    bool has_space = variable->doc_type == STR_color3 || variable->doc_type == STR_color4
                     || variable->type == IR_TYPE_SAMPLER;
    const char *working = osl->spell->options->colorspace;
    return has_space && !(working && strcmp(space, working) == 0) ? space : NULL;
}

/* "a:0|b:1" from the names "a, b" and the values "0, 1"; without values, they count from 0. */
static void write_choices(struct spell *spell, const char *names, const char *values,
                          unsigned *count)
{
    write_piece(spell, "string widget = \"mapper\", string options = \"", count);
    for (unsigned i = 0; *names; i++) {
        size_t n = strcspn(names, ","), m = strcspn(values, ",");
        spell_text(spell, i ? "|" : "");
        text_mem(spell->out, names, n);
        text_char(spell->out, ':');
        if (*values)
            text_mem(spell->out, values, m);
        else
            spell_number(spell, i);
        names += n + (names[n] == ',');
        names += strspn(names, " ");
        values += m + (values[m] == ',');
        values += strspn(values, " ");
    }
    spell_text(spell, "\"");
}

static void write_widget(struct spell *spell, const struct shader_variable *variable,
                         const struct shader_ui *ui, unsigned *count)
{
    bool has_choices = variable->type == IR_TYPE_INT && ui->enum_names && *ui->enum_names;
    if (has_choices)
        write_choices(spell, ui->enum_names, ui->enum_values ? ui->enum_values : "", count);
    else
        write_hint(spell, "widget",
                   variable->type == IR_TYPE_BOOL      ? "checkBox"
                   : variable->type == IR_TYPE_SAMPLER ? "filename"
                                                       : NULL,
                   count);
}

void osl_write_metadata(struct osl *osl, const struct shader_variable *variable)
{
    struct spell *spell = osl->spell;
    struct shader_ui ui;
    unsigned count = 0;
    if (spell->options->metadata == 0)
        return;
    find_ui(spell, variable, &ui);
    write_label(spell, text_of(osl, variable->name), ui.uiname, &count);
    write_shared(osl, hint_text(spell, "page", ui.uifolder), &count);
    write_shared(osl, range_text(spell, variable, &ui), &count);
    write_widget(spell, variable, &ui, &count);
    write_hint(spell, "colorspace", colorspace_of(osl, variable), &count);
    if (spell->options->metadata > 1)
        write_hint(spell, "help", ui.doc, &count);
    if (count)
        spell_text(spell, " ]]");
}
