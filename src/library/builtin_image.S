// SPDX-License-Identifier: Apache-2.0
/*
 * The built-in node library: the file MXG_IMAGE, byte for byte, where it can be used without being read or copied. Without
 * MXG_IMAGE the image is empty: that is what the program which packs the library is linked to.
 */
#ifdef _WIN32
    .section .rdata, "dr"
#else
    .section .rodata
    .hidden mxg_builtin_image, mxg_builtin_image_end
#endif
    .balign 64
    .globl mxg_builtin_image, mxg_builtin_image_end
mxg_builtin_image:
#ifdef MXG_IMAGE
    .incbin MXG_IMAGE
#endif
mxg_builtin_image_end:
    .byte 0
#ifndef _WIN32
    .section .note.GNU-stack, "", %progbits
#endif
