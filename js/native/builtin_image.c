// SPDX-License-Identifier: Apache-2.0
/* src/library/builtin_image.S for WebAssembly, whose assembler needs the type and size of each
 * symbol. */
__asm__("    .hidden mxg_builtin_image\n"
        "    .hidden mxg_builtin_image_end\n"
        "    .section .rodata.mxg_builtin_image, \"\", @\n"
        "    .globl mxg_builtin_image\n"
        "    .globl mxg_builtin_image_end\n"
        "    .p2align 6\n"
        "mxg_builtin_image:\n"
        "    .incbin \"" MXG_IMAGE "\"\n"
        "mxg_builtin_image_end:\n"
        "    .int8 0\n"
        "    .size mxg_builtin_image, mxg_builtin_image_end - mxg_builtin_image\n"
        "    .size mxg_builtin_image_end, 1\n");
