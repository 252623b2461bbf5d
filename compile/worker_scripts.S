// SPDX-License-Identifier: Apache-2.0
/* The scripts of compiler_process.c: a compiler's part, then the loop that answers requests. */
    .section .rodata
    .globl compile_slang_script
    .hidden compile_slang_script
compile_slang_script:
    .incbin "compile/slang.mjs"
    .incbin "compile/answer.mjs"
    .byte 0
    .globl compile_dawn_script
    .hidden compile_dawn_script
compile_dawn_script:
    .incbin "compile/dawn.mjs"
    .incbin "compile/answer.mjs"
    .byte 0
    .section .note.GNU-stack, "", %progbits
