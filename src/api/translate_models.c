// SPDX-License-Identifier: Apache-2.0
/*
 * The models that a surface can become. A translation is a node of the library that computes the
 * inputs of one model from those of another: its name is `A_to_B`, its group "translation", and
 * each of its outputs has the name of an input of B with "_out". So a library with a node
 * `studio_to_open_pbr_surface` adds a model. Those with a version come first: the nodes of
 * MaterialX have none, and mxgen has better ones for some of their pairs.
 */
#include "api/translate.h"

static const char between[] = "_to_";

static mxg_nodedef definition_at(const struct translation *t, uint32_t index)
{
    mxg_nodedef definition = {.size = sizeof definition};
    mxg_document_nodedef(t->document, index, &definition);
    return definition;
}

const char *translate_output_name(const struct translation *t, const char *input)
{
    struct text name;
    text_init(&name, t->arena);
    text_fmt(&name, "%s_out", input);
    return text_cstr(&name);
}

bool translate_find_port(const struct translation *t, uint32_t definition, const char *name,
                         bool is_output, mxg_port *out)
{
    mxg_nodedef info = definition_at(t, definition);
    uint32_t first = is_output ? info.num_inputs : 0;
    uint32_t end = is_output ? first + info.num_outputs : info.num_inputs;
    for (uint32_t i = first; i < end; i++) {
        *out = (mxg_port){.size = sizeof *out};
        mxg_document_port(t->document, definition, i, out);
        if (strcmp(out->name, name) == 0)
            return true;
    }
    return false;
}

/* Lists the translations of the library and the document. */
static void list_steps(struct translation *t)
{
    uint32_t count = mxg_document_num_nodedefs(t->document);
    for (uint32_t i = 0; i < count; i++) {
        mxg_nodedef info = definition_at(t, i);
        const char *split = strstr(info.node, between);
        if (!split || strcmp(info.group, "translation") != 0)
            continue;
        const char *from = arena_strndup(t->kept, info.node, (size_t)(split - info.node));
        vec_push(t->kept, &t->steps,
                 (struct translation_step){i, from, split + strlen(between), *info.version != 0});
    }
}

bool translate_find_surface(const struct translation *t, const char *model, uint32_t *out)
{
    uint32_t count = mxg_document_num_nodedefs(t->document);
    bool found = false;
    for (uint32_t i = 0; i < count && !found; i++) {
        mxg_nodedef info = definition_at(t, i);
        mxg_port port = {.size = sizeof port};
        if (strcmp(info.node, model) != 0 || info.num_outputs != 1
            || (*info.version && !info.is_default_version))
            continue;
        mxg_document_port(t->document, i, info.num_inputs, &port);
        found = strcmp(port.type, "surfaceshader") == 0;
        *out = i;
    }
    return found;
}

/* True if a translation before `index` makes the same model. */
static bool is_listed(const struct translation *t, uint32_t index)
{
    bool is = false;
    for (uint32_t i = 0; i < index && !is; i++)
        is = strcmp(t->steps.items[i].to, t->steps.items[index].to) == 0;
    return is;
}

bool translate_find_model(struct translation *t)
{
    bool is_made = false;
    t->steps.len = 0;
    list_steps(t);
    for (uint32_t i = 0; i < t->steps.len && !is_made; i++)
        is_made = strcmp(t->steps.items[i].to, t->model) == 0;
    if (is_made && translate_find_surface(t, t->model, &t->definition))
        return true;
    struct text known;
    struct diag_guess guess;
    text_init(&known, t->arena);
    bool guesses = diag_guess_begin(&guess, t->diags, t->model);
    for (uint32_t i = 0; i < t->steps.len; i++) {
        if (is_listed(t, i))
            continue;
        text_fmt(&known, "%s%s", known.len ? ", " : "", t->steps.items[i].to);
        if (guesses)
            diag_guess_add(&guess, t->steps.items[i].to);
    }
    diag_add(t->diags, DIAG_ID_unknown_model, (struct diag_place){0}, t->model,
             guesses ? diag_guess_text(&guess) : "", text_cstr(&known));
    return false;
}

/* A model that the search has reached, by which step, and from which place of the search. */
struct reached {
    const char *model;
    uint32_t step, before;
};

#define NO_STEP UINT32_MAX

static void fill_chain(struct translation *t, const struct reached *all, uint32_t last)
{
    uint32_t len = 0;
    for (uint32_t at = last; all[at].before != NO_STEP; at = all[at].before)
        len++;
    t->chain.len = 0;
    uint32_t *chain = vec_extend(t->arena, &t->chain, len);
    for (uint32_t at = last; all[at].before != NO_STEP; at = all[at].before)
        chain[--len] = t->steps.items[all[at].step].definition;
}

static bool find_chain(struct translation *t, const char *category, const char *to,
                       bool are_versioned)
{
    struct reached *all = ARENA_ARRAY(t->arena, struct reached, t->steps.len + 1);
    uint32_t count = 0;
    all[count++] = (struct reached){category, NO_STEP, NO_STEP};
    /* the nearest first, so the chain is one of the shortest; each step adds one model at most */
    for (uint32_t at = 0; at < count; at++) {
        if (strcmp(all[at].model, to) == 0) {
            fill_chain(t, all, at);
            return true;
        }
        for (uint32_t i = 0; i < t->steps.len; i++) {
            const struct translation_step *step = &t->steps.items[i];
            bool is_new =
                strcmp(step->from, all[at].model) == 0 && (step->has_version || !are_versioned);
            for (uint32_t k = 0; k < count && is_new; k++)
                is_new = strcmp(all[k].model, step->to) != 0;
            if (is_new)
                all[count++] = (struct reached){step->to, i, at};
        }
    }
    return false;
}

bool translate_find_chain(struct translation *t, const char *category, const char *to)
{
    return find_chain(t, category, to, true) || find_chain(t, category, to, false);
}

bool translate_leads(struct translation *t, elem_id node)
{
    const struct document *doc = &t->document->layer.doc;
    const char *category = str_text(doc->strings, doc_element(doc, node)->category);
    bool leads = strcmp(category, t->wanted) == 0 || translate_find_chain(t, category, t->wanted);
    memset(&t->chain, 0, sizeof t->chain); /* the arena may end before the next one */
    return leads;
}
