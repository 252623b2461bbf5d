// SPDX-License-Identifier: Apache-2.0
/* Memory and lifetime of objects. */
#include "api/api.h"

/* Sets the memory limit of an object: the rest of the context's limit after the other objects. */
static void init_mem(struct mem *mem, struct mxg_context *context)
{
    mem_init(mem, context->mem.realloc, context->mem.user_data);
    if (!context->max_memory)
        return;
    size_t used = atomic_load(&context->used);
    /* 0 would mean no limit */
    mem->limit = used < context->max_memory ? context->max_memory - used : 1;
}

void object_init(struct object *object, struct mxg_context *context, size_t size)
{
    object->context = context;
    object->size = size;
    atomic_init(&object->refs, 1);
    init_mem(&object->mem, context);
    arena_init(&object->arena, &object->mem);
    object->diagnostics.owner = object;
    diag_list_init(&object->diagnostics.list, &object->arena);
    object->diagnostics.list.max_errors = context->max_errors;
    object->diagnostics.list.policy = &context->policy;
    for (unsigned i = 0; i < OBJECT_MAX_TEXTS; i++)
        atomic_init(&object->texts[i], NULL);
}

struct allocation {
    struct mem *mem;
    size_t size;
    void *block;
};

static void allocate(void *arg)
{
    struct allocation *allocation = arg;
    allocation->block = mem_realloc(allocation->mem, NULL, 0, allocation->size);
}

void object_settle(struct object *object)
{
    struct mxg_context *context = object->context;
    /* the difference wraps if the object shrinks */
    size_t now = object->mem.used + object->size, more = now - object->counted;
    size_t others = atomic_fetch_add(&context->used, more) + more - object->mem.used;
    object->counted = now;
    if (!context->max_memory)
        return;
    size_t left = others < context->max_memory ? context->max_memory - others : 1;
    /* 0 would mean no limit */
    object->mem.limit = left > object->mem.used ? left : object->mem.used + 1;
}

void *object_new(struct mxg_context *context, size_t size, struct object *below)
{
    struct mem mem;
    init_mem(&mem, context);
    struct allocation allocation = {&mem, size, NULL};
    if (!mem_try(&mem, allocate, &allocation))
        return NULL;
    struct object *object = memset(allocation.block, 0, size);
    object_init(object, context, size);
    object->below = below;
    if (below)
        object_ref(below);
    object_settle(object);
    return object;
}

void object_ref(struct object *object)
{
    atomic_fetch_add_explicit(&object->refs, 1, memory_order_relaxed);
}

static void free_text(struct mxg_context *context, struct made_text *text)
{
    struct mem mem = text->mem; /* a copy, because the block contains the original */
    text->arena.mem = &mem;
    atomic_fetch_sub(&context->used, mem.used);
    struct arena arena = text->arena;
    arena_finish(&arena);
}

void object_empty(struct object *object)
{
    for (unsigned i = 0; i < OBJECT_MAX_TEXTS; i++) {
        struct made_text *text = atomic_load(&object->texts[i]);
        if (text)
            free_text(object->context, text);
    }
    arena_finish(&object->arena);
}

static void free_object(struct object *object)
{
    struct mxg_context *context = object->context;
    object_empty(object);
    atomic_fetch_sub(&context->used, object->counted);
    struct mem mem = object->mem;
    mem.used = object->size;
    mem_realloc(&mem, object, object->size, 0);
}

void object_unref(struct object *object)
{
    while (object && atomic_fetch_sub_explicit(&object->refs, 1, memory_order_acq_rel) == 1) {
        struct object *below = object->below;
        free_object(object);
        object = below;
    }
}

mxg_status object_run(struct object *object, void (*work)(void *arg), void *arg)
{
    object_settle(object);
    bool done = mem_try(&object->mem, work, arg);
    object_settle(object);
    return done ? MXG_OK : MXG_ERROR_MEMORY;
}

struct scratch_job {
    void (*work)(void *arg, struct arena *scratch);
    void *arg;
    struct arena scratch;
};

static void run_scratch_job(void *arg)
{
    struct scratch_job *job = arg;
    job->work(job->arg, &job->scratch);
}

mxg_status context_run(struct mxg_context *context, void (*work)(void *arg, struct arena *scratch),
                       void *arg)
{
    struct mem mem;
    init_mem(&mem, context);
    struct scratch_job job = {.work = work, .arg = arg};
    arena_init(&job.scratch, &mem);
    bool done = mem_try(&mem, run_scratch_job, &job);
    arena_finish(&job.scratch);
    return done ? MXG_OK : MXG_ERROR_MEMORY;
}

struct text_job {
    const struct object *object;
    void (*write)(const struct object *object, struct text *out);
    struct arena arena;
    struct made_text *made;
};

/* The arena of the text contains the block of the text. */
static void write_text(void *arg)
{
    struct text_job *job = arg;
    job->made = ARENA_NEW(&job->arena, struct made_text);
    struct text out;
    text_init(&out, &job->arena);
    job->write(job->object, &out);
    job->made->data = text_cstr(&out);
    job->made->size = out.len;
}

const struct made_text *object_text(const struct object *object, unsigned index,
                                    void (*write)(const struct object *object, struct text *out))
{
    /* objects themselves are never const */
    struct object *owner = (struct object *)(uintptr_t)object;
    struct made_text *found = atomic_load(&owner->texts[index]);
    if (found)
        return found;
    struct mem mem;
    init_mem(&mem, object->context);
    struct text_job job = {.object = object, .write = write};
    arena_init(&job.arena, &mem);
    if (!mem_try(&mem, write_text, &job)) {
        arena_finish(&job.arena);
        return NULL;
    }
    job.made->mem = mem;
    job.made->arena = job.arena;
    atomic_fetch_add(&object->context->used, mem.used);
    if (atomic_compare_exchange_strong(&owner->texts[index], &found, job.made))
        return job.made;
    free_text(object->context, job.made); /* another thread has set the text first */
    return found;
}
