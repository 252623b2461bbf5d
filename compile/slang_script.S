// SPDX-License-Identifier: Apache-2.0
/* The text of slang.mjs, for slang.c. */
    .section .rodata
    .globl compile_slang_script
    .hidden compile_slang_script
compile_slang_script:
    .incbin MXG_SLANG_SCRIPT
    .byte 0
    .section .note.GNU-stack, "", %progbits
