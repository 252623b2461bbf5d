// SPDX-License-Identifier: Apache-2.0
/*
 * bench-gpustat VERTEX.spv PIXEL.spv, or COMPUTE.spv: makes a pipeline of the modules and prints
 * the driver's statistics of the last stage, one per line: "name=value". With
 * RADV_FORCE_FAMILY=navi21 Mesa compiles for an AMD GPU that need not be there. The process ends
 * without cleaning up.
 */
#include "spirv_interface.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

enum { MAX_STATISTICS = 64, MAX_EXECUTABLES = 8 };

static void fail(const char *what)
{
    fprintf(stderr, "gpustat: %s\n", what);
    exit(1);
}

static void check(VkResult result, const char *what)
{
    if (result != VK_SUCCESS)
        fail(what);
}

struct module {
    uint32_t *words;
    size_t size; /* in bytes */
};

static struct module read_module(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file || fseek(file, 0, SEEK_END) != 0)
        fail(path);
    long size = ftell(file);
    rewind(file);
    struct module module = {malloc(size > 0 ? (size_t)size : 1), (size_t)size};
    if (size <= 0 || !module.words || fread(module.words, 1, module.size, file) != module.size)
        fail(path);
    fclose(file);
    return module;
}

static VkPhysicalDevice first_device(void)
{
    VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                     .apiVersion = VK_API_VERSION_1_3};
    VkInstanceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                 .pApplicationInfo = &application};
    VkInstance instance;
    check(vkCreateInstance(&info, NULL, &instance), "no Vulkan");
    uint32_t count = 1;
    VkPhysicalDevice device = VK_NULL_HANDLE;
    vkEnumeratePhysicalDevices(instance, &count, &device);
    if (count == 0)
        fail("no device");
    return device;
}

static VkDevice make_device(VkPhysicalDevice physical)
{
    static const char *const extensions[] = {"VK_KHR_pipeline_executable_properties"};
    float priority = 1.0f;
    VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                     .queueCount = 1,
                                     .pQueuePriorities = &priority};
    VkPhysicalDevicePipelineExecutablePropertiesFeaturesKHR statistics = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PIPELINE_EXECUTABLE_PROPERTIES_FEATURES_KHR,
        .pipelineExecutableInfo = VK_TRUE};
    VkPhysicalDeviceVulkan13Features features = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
        .pNext = &statistics,
        .dynamicRendering = VK_TRUE,
        .shaderDemoteToHelperInvocation = VK_TRUE};
    VkDeviceCreateInfo info = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                               .pNext = &features,
                               .queueCreateInfoCount = 1,
                               .pQueueCreateInfos = &queue,
                               .enabledExtensionCount = 1,
                               .ppEnabledExtensionNames = extensions};
    VkDevice device;
    check(vkCreateDevice(physical, &info, NULL, &device), "the device has no pipeline statistics");
    return device;
}

static VkPipelineLayout make_layout(VkDevice device, const struct shader_interface *interface)
{
    VkDescriptorSetLayout sets[MAX_SETS];
    for (uint32_t set = 0; set < MAX_SETS; set++) {
        VkDescriptorSetLayoutBinding bindings[MAX_RESOURCES];
        uint32_t count = 0;
        for (uint32_t i = 0; i < interface->num_resources; i++)
            if (interface->resources[i].set == set)
                bindings[count++] = interface->resources[i].layout;
        VkDescriptorSetLayoutCreateInfo info = {
            .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO,
            .bindingCount = count,
            .pBindings = bindings};
        check(vkCreateDescriptorSetLayout(device, &info, NULL, &sets[set]), "no set layout");
    }
    VkPipelineLayoutCreateInfo info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO,
                                       .setLayoutCount = MAX_SETS,
                                       .pSetLayouts = sets};
    VkPipelineLayout layout;
    check(vkCreatePipelineLayout(device, &info, NULL, &layout), "no pipeline layout");
    return layout;
}

static VkPipelineShaderStageCreateInfo make_stage(VkDevice device, const struct module *module,
                                                  VkShaderStageFlagBits stage)
{
    VkShaderModuleCreateInfo info = {.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO,
                                     .codeSize = module->size,
                                     .pCode = module->words};
    VkShaderModule made;
    check(vkCreateShaderModule(device, &info, NULL, &made), "no shader module");
    return (VkPipelineShaderStageCreateInfo){
        .sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
        .stage = stage,
        .module = made,
        .pName = "main"};
}

/* The state that does not change with the shader; the caller fills the rest in. */
static VkGraphicsPipelineCreateInfo fixed_state(void)
{
    static const VkPipelineInputAssemblyStateCreateInfo assembly = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO,
        .topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST};
    static const VkViewport viewport = {.width = 64.0f, .height = 64.0f, .maxDepth = 1.0f};
    static const VkRect2D scissor = {.extent = {64, 64}};
    static const VkPipelineViewportStateCreateInfo viewports = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO,
        .viewportCount = 1,
        .pViewports = &viewport,
        .scissorCount = 1,
        .pScissors = &scissor};
    static const VkPipelineRasterizationStateCreateInfo raster = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO, .lineWidth = 1.0f};
    static const VkPipelineMultisampleStateCreateInfo samples = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO,
        .rasterizationSamples = VK_SAMPLE_COUNT_1_BIT};
    static const VkPipelineDepthStencilStateCreateInfo depth = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO};
    return (VkGraphicsPipelineCreateInfo){.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO,
                                          .flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR,
                                          .pInputAssemblyState = &assembly,
                                          .pViewportState = &viewports,
                                          .pRasterizationState = &raster,
                                          .pMultisampleState = &samples,
                                          .pDepthStencilState = &depth};
}

/* One buffer of floats for each vertex input. */
static void describe_inputs(const struct shader_interface *interface,
                            VkVertexInputBindingDescription *buffers,
                            VkVertexInputAttributeDescription *inputs)
{
    static const VkFormat formats[] = {VK_FORMAT_R32_SFLOAT, VK_FORMAT_R32G32_SFLOAT,
                                       VK_FORMAT_R32G32B32_SFLOAT, VK_FORMAT_R32G32B32A32_SFLOAT};
    for (uint32_t i = 0; i < interface->num_inputs; i++) {
        uint32_t components = interface->inputs[i].components;
        buffers[i] = (VkVertexInputBindingDescription){.binding = i, .stride = 16};
        inputs[i] = (VkVertexInputAttributeDescription){
            .location = interface->inputs[i].location,
            .binding = i,
            .format = formats[components >= 1 && components <= 4 ? components - 1 : 3]};
    }
}

static VkPipeline make_compute(VkDevice device, const struct shader_interface *interface,
                               const VkPipelineShaderStageCreateInfo *stage)
{
    VkComputePipelineCreateInfo info = {.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO,
                                        .flags = VK_PIPELINE_CREATE_CAPTURE_STATISTICS_BIT_KHR,
                                        .stage = *stage,
                                        .layout = make_layout(device, interface)};
    VkPipeline pipeline;
    check(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline),
          "the driver refuses the shader");
    return pipeline;
}

static VkPipeline make_pipeline(VkDevice device, const struct shader_interface *interface,
                                const VkPipelineShaderStageCreateInfo *stages)
{
    VkVertexInputBindingDescription buffers[MAX_INPUTS];
    VkVertexInputAttributeDescription inputs[MAX_INPUTS];
    describe_inputs(interface, buffers, inputs);
    VkPipelineVertexInputStateCreateInfo vertices = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO,
        .vertexBindingDescriptionCount = interface->num_inputs,
        .pVertexBindingDescriptions = buffers,
        .vertexAttributeDescriptionCount = interface->num_inputs,
        .pVertexAttributeDescriptions = inputs};
    VkPipelineColorBlendAttachmentState blends[MAX_OUTPUTS];
    VkFormat formats[MAX_OUTPUTS];
    uint32_t num_outputs = interface->num_outputs;
    for (uint32_t i = 0; i < num_outputs; i++) {
        blends[i] = (VkPipelineColorBlendAttachmentState){.colorWriteMask = 15};
        formats[i] = interface->is_integer[i] ? VK_FORMAT_R32_UINT : VK_FORMAT_R32G32B32A32_SFLOAT;
    }
    VkPipelineColorBlendStateCreateInfo blend = {
        .sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO,
        .attachmentCount = num_outputs,
        .pAttachments = blends};
    VkPipelineRenderingCreateInfo rendering = {.sType =
                                                   VK_STRUCTURE_TYPE_PIPELINE_RENDERING_CREATE_INFO,
                                               .colorAttachmentCount = num_outputs,
                                               .pColorAttachmentFormats = formats};
    VkGraphicsPipelineCreateInfo info = fixed_state();
    info.pNext = &rendering;
    info.stageCount = 2;
    info.pStages = stages;
    info.pVertexInputState = &vertices;
    info.pColorBlendState = &blend;
    info.layout = make_layout(device, interface);
    VkPipeline pipeline;
    check(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, NULL, &pipeline),
          "the driver refuses the shader");
    return pipeline;
}

static void print_executable(VkDevice device, VkPipeline pipeline, uint32_t index)
{
    PFN_vkGetPipelineExecutableStatisticsKHR get =
        (PFN_vkGetPipelineExecutableStatisticsKHR)vkGetDeviceProcAddr(
            device, "vkGetPipelineExecutableStatisticsKHR");
    VkPipelineExecutableInfoKHR info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_INFO_KHR,
                                        .pipeline = pipeline,
                                        .executableIndex = index};
    VkPipelineExecutableStatisticKHR statistics[MAX_STATISTICS];
    uint32_t count = MAX_STATISTICS;
    for (uint32_t i = 0; i < count; i++)
        statistics[i] = (VkPipelineExecutableStatisticKHR){
            .sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_STATISTIC_KHR};
    get(device, &info, &count, statistics);
    for (uint32_t i = 0; i < count; i++)
        if (statistics[i].format == VK_PIPELINE_EXECUTABLE_STATISTIC_FORMAT_UINT64_KHR)
            printf("%s=%" PRIu64 "\n", statistics[i].name, statistics[i].value.u64);
}

static void print_stage(VkDevice device, VkPipeline pipeline, VkShaderStageFlags stage)
{
    PFN_vkGetPipelineExecutablePropertiesKHR get =
        (PFN_vkGetPipelineExecutablePropertiesKHR)vkGetDeviceProcAddr(
            device, "vkGetPipelineExecutablePropertiesKHR");
    VkPipelineInfoKHR info = {.sType = VK_STRUCTURE_TYPE_PIPELINE_INFO_KHR, .pipeline = pipeline};
    VkPipelineExecutablePropertiesKHR properties[MAX_EXECUTABLES];
    uint32_t count = MAX_EXECUTABLES;
    for (uint32_t i = 0; i < count; i++)
        properties[i] = (VkPipelineExecutablePropertiesKHR){
            .sType = VK_STRUCTURE_TYPE_PIPELINE_EXECUTABLE_PROPERTIES_KHR};
    get(device, &info, &count, properties);
    for (uint32_t i = 0; i < count; i++)
        if (properties[i].stages & stage)
            print_executable(device, pipeline, i);
}

int main(int argc, char **argv)
{
    static const VkShaderStageFlagBits drawn[] = {VK_SHADER_STAGE_VERTEX_BIT,
                                                  VK_SHADER_STAGE_FRAGMENT_BIT},
                                       computed[] = {VK_SHADER_STAGE_COMPUTE_BIT};
    static struct shader_interface interface;
    struct module modules[2];
    VkPipelineShaderStageCreateInfo stages[2];
    if (argc != 2 && argc != 3)
        fail("usage: bench-gpustat VERTEX.spv PIXEL.spv | COMPUTE.spv");
    const VkShaderStageFlagBits *bits = argc == 3 ? drawn : computed;
    unsigned count = (unsigned)argc - 1;
    VkDevice device = make_device(first_device());
    for (unsigned i = 0; i < count; i++) {
        modules[i] = read_module(argv[i + 1]);
        if (!interface_of_module(modules[i].words, modules[i].size / 4, bits[i], &interface))
            fail(argv[i + 1]);
        stages[i] = make_stage(device, &modules[i], bits[i]);
    }
    VkPipeline pipeline = argc == 3 ? make_pipeline(device, &interface, stages)
                                    : make_compute(device, &interface, stages);
    print_stage(device, pipeline, bits[count - 1]);
    fflush(stdout);
    _Exit(0); /* RADV without a GPU may hang in its destructors */
}
