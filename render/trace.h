// SPDX-License-Identifier: Apache-2.0
/* The path tracer: traces paths through the scene with a shader for the role scatter. */
#ifndef MXG_RENDER_TRACE_H
#define MXG_RENDER_TRACE_H

#include "render/aovs.h"
#include "render/bind_shader.h"
#include "render/descriptors.h"
#include "compile/compile.h"

/* path_structs.glsl, scene.glsl, path.glsl, media.glsl, body.glsl, matter.glsl and volume.glsl, as
 * lines in pieces; ends with NULL. */
extern const char *const trace_source[];

struct trace_options {
    uint32_t paths;   /* per pixel */
    uint32_t bounces; /* maximum number of bounces */
    /* of a closure, for each path where it hits first: with equal random numbers, but evenly */
    uint32_t picks;
    bool dark; /* no light from the environment */
    /*
     * one bounce without shadows; a path that enters a solid leaves it at the other side without
     * loss
     */
    bool as_drawn;
    struct aovs *aovs; /* whose pixels are filled, for the first hit of each path; NULL: none */
    void (*progress)(void *user_data, uint32_t done, uint32_t of); /* may be NULL */
    void *progress_data;
};

/*
 * Traces paths through all objects of the shaders, and fills `pixels` and `through` of the image;
 * the opacity is 1 - the mean of what goes straight through. `binds` as for render_open. false: see
 * id and reason of binds[*out_failed]. Call bind_finish in any case.
 */
bool trace_picture(struct gpu *gpu, struct bind *const *binds, size_t count,
                   const struct trace_options *options, struct image *out, size_t *out_failed);

/* kernel.c: the shader of one `bind`, with the path tracer around it. */
struct kernel_program {
    struct compiled compiled;
    VkPipelineLayout layout;
    VkPipeline pipeline;
};
struct kernel {
    struct bind *bind;
    mxg_shader_info info;
    struct inputs inputs;
    /*
     * prepares: runs before `paths`, where there is something to find first. It is a program of its
     * own, because drivers leave out of it what that does not need.
     */
    struct kernel_program paths, prepares;
    const char *prepared; /* the macro of `prepares`, "DISPLACES" or "MEASURES"; "": it has none */
    bool is_volume;
    uint32_t first_shader, num_shaders; /* numbers: one, or one for each object */
};
/* Binds the shader and finds its numbers: from `first_shader` on. false: see bind->reason. */
bool kernel_open(struct gpu *gpu, struct bind *bind, uint32_t first_shader, struct kernel *out);
/* Compiles it; the tracer's set comes after the sets of the shader. */
bool kernel_compile(struct gpu *gpu, struct kernel *kernel, VkDescriptorSetLayout set_layout,
                    const struct trace_options *options);
void kernel_close(struct gpu *gpu, struct kernel *kernel);
/*
 * The values that the shader reads from an object (hit_value() in path.glsl): for each attribute
 * those of all corners. `out` has room for kernel_num_values of four floats.
 */
size_t kernel_num_values(const struct kernel *kernel, uint32_t object);
void kernel_values(const struct kernel *kernel, uint32_t object, float (*out)[4]);
/* Keeps the first reason of a failure. */
bool kernel_fail(struct kernel *kernel, const char *id, const char *text);

#endif
