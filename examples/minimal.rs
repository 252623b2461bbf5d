// SPDX-License-Identifier: Apache-2.0
// c_minimal.c in Rust, with declarations by hand; `bindgen mxgen.h` makes all of them.
//
//     rustc minimal.rs -l mxgen && ./minimal gold.mtlx
use std::ffi::{c_char, CStr, CString};
use std::mem::size_of;
use std::ptr::{null, null_mut};

// Objects of mxgen are opaque.
enum Context {}
enum Library {}
enum Document {}
enum Result {}
enum Diagnostics {}

// A struct may end after any member: its size tells mxgen which ones there are.
#[repr(C)]
struct GenerateDesc {
    size: usize,
    target: *const c_char,
    element: *const c_char,
}

extern "C" {
    fn mxg_context_create(desc: *const u8, out: *mut *mut Context) -> i32;
    fn mxg_context_destroy(context: *mut Context);
    fn mxg_library_builtin(context: *mut Context) -> *mut Library;
    fn mxg_library_unref(library: *mut Library);
    fn mxg_document_load(context: *mut Context, library: *mut Library, path: *const c_char, out: *mut *mut Document) -> i32;
    fn mxg_document_diagnostics(document: *const Document) -> *const Diagnostics;
    fn mxg_document_destroy(document: *mut Document);
    fn mxg_generate(context: *mut Context, document: *const Document, desc: *const GenerateDesc, out: *mut *mut Result) -> i32;
    fn mxg_result_diagnostics(result: *const Result) -> *const Diagnostics;
    fn mxg_result_source(result: *const Result, stage: i32, size: *mut usize) -> *const c_char;
    fn mxg_result_destroy(result: *mut Result);
    fn mxg_diagnostics_num_items(list: *const Diagnostics) -> u32;
    fn mxg_diagnostics_format(list: *const Diagnostics, index: u32, line: *const c_char, line_size: usize, colour: bool,
                              buffer: *mut c_char, capacity: usize) -> usize;
}

const OK: i32 = 0;
const PIXEL: i32 = 1;

unsafe fn print_diagnostics(list: *const Diagnostics) {
    for index in 0..mxg_diagnostics_num_items(list) {
        let size = mxg_diagnostics_format(list, index, null(), 0, false, null_mut(), 0);
        let mut text = vec![0u8; size + 1];
        mxg_diagnostics_format(list, index, null(), 0, false, text.as_mut_ptr().cast(), text.len());
        eprintln!("{}", String::from_utf8_lossy(&text[..size]));
    }
}

unsafe fn run(path: &CStr) -> i32 {
    let (mut context, mut document, mut result) = (null_mut(), null_mut(), null_mut());
    if mxg_context_create(null(), &mut context) != OK {
        return 1;
    }
    let library = mxg_library_builtin(context);
    let mut status = mxg_document_load(context, library, path.as_ptr(), &mut document);
    print_diagnostics(mxg_document_diagnostics(document));
    if status == OK {
        let target = CString::new("glsl").unwrap();
        let desc = GenerateDesc { size: size_of::<GenerateDesc>(), target: target.as_ptr(), element: null() };
        status = mxg_generate(context, document, &desc, &mut result);
        print_diagnostics(mxg_result_diagnostics(result));
    }
    if status == OK {
        println!("{}", CStr::from_ptr(mxg_result_source(result, PIXEL, null_mut())).to_str().unwrap());
    }
    mxg_result_destroy(result); // null is allowed everywhere here
    mxg_document_destroy(document);
    mxg_library_unref(library);
    mxg_context_destroy(context);
    (status != OK) as i32
}

fn main() {
    let path = std::env::args().nth(1).expect("usage: minimal MATERIAL.mtlx");
    std::process::exit(unsafe { run(&CString::new(path).unwrap()) });
}
