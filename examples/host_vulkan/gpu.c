// SPDX-License-Identifier: Apache-2.0
/* The frame of the host: a colour, a depth, and a file for what was drawn. */
#include "gpu.h"

#include <stdio.h>

static void make_frame(struct gpu *g)
{
    const VkFormat formats[] = {VK_FORMAT_R8G8B8A8_SRGB, VK_FORMAT_D32_SFLOAT};
    g->color =
        device_make_image(&g->device, formats[0], SIZE, SIZE, 1,
                          VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT);
    g->depth = device_make_image(&g->device, formats[1], SIZE, SIZE, 1,
                                 VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
    g->readback = device_make_buffer(&g->device, SIZE * SIZE * 4);
    VkAttachmentDescription attachments[2];
    for (int i = 0; i < 2; ++i)
        attachments[i] = (VkAttachmentDescription){
            .format = formats[i],
            .samples = VK_SAMPLE_COUNT_1_BIT,
            .loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR,
            .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
            .finalLayout = i ? VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL
                             : VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL};
    VkSubpassDescription subpass = {
        .colorAttachmentCount = 1,
        .pColorAttachments = &(VkAttachmentReference){0, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL},
        .pDepthStencilAttachment =
            &(VkAttachmentReference){1, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL}};
    VkRenderPassCreateInfo pass = {.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO,
                                   .attachmentCount = 2,
                                   .pAttachments = attachments,
                                   .subpassCount = 1,
                                   .pSubpasses = &subpass};
    VK(vkCreateRenderPass(g->device.device, &pass, NULL, &g->pass));
    VkImageView views[] = {g->color.view, g->depth.view};
    VkFramebufferCreateInfo frame = {.sType = VK_STRUCTURE_TYPE_FRAMEBUFFER_CREATE_INFO,
                                     .renderPass = g->pass,
                                     .attachmentCount = 2,
                                     .pAttachments = views,
                                     .width = SIZE,
                                     .height = SIZE,
                                     .layers = 1};
    VK(vkCreateFramebuffer(g->device.device, &frame, NULL, &g->frame));
}

void gpu_open(struct gpu *g)
{
    device_open(&g->device, NULL);
    make_frame(g);
}

void gpu_write_picture(struct gpu *g, VkCommandBuffer commands, const char *path)
{
    vkCmdCopyImageToBuffer(
        commands, g->color.image, VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, g->readback.buffer, 1,
        &(VkBufferImageCopy){.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1},
                             .imageExtent = {SIZE, SIZE, 1}});
    device_run(&g->device, commands);
    FILE *file = fopen(path, "wb");
    check(file, path);
    fprintf(file, "P6 %d %d 255\n", SIZE, SIZE);
    for (int i = 0; i < SIZE * SIZE; ++i)
        fwrite(g->readback.bytes + 4 * i, 1, 3, file);
    check(fclose(file) == 0, path);
}

void gpu_close(struct gpu *g)
{
    device_free_image(&g->device, g->color);
    device_free_image(&g->device, g->depth);
    device_free_buffer(&g->device, g->readback);
    vkDestroyFramebuffer(g->device.device, g->frame, NULL);
    vkDestroyRenderPass(g->device.device, g->pass, NULL);
    device_close(&g->device);
}
