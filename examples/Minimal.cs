// SPDX-License-Identifier: Apache-2.0
// c_minimal.c in .NET, with declarations by hand.
//
//     mcs Minimal.cs && mono Minimal.exe gold.mtlx        (or a project of dotnet)
using System;
using System.Runtime.InteropServices;
using System.Text;

static class Minimal
{
    const string Library = "mxgen";
    const int Ok = 0, Pixel = 1;

    // A struct may end after any member: its size tells mxgen which ones there are. Objects of mxgen are IntPtr; a class with SafeHandle
    // can own them.
    [StructLayout(LayoutKind.Sequential)]
    struct GenerateDesc
    {
        public UIntPtr Size;
        public IntPtr Target;
        public IntPtr Element;
    }

    [DllImport(Library)] static extern int mxg_context_create(IntPtr desc, out IntPtr context);
    [DllImport(Library)] static extern void mxg_context_destroy(IntPtr context);
    [DllImport(Library)] static extern IntPtr mxg_library_builtin(IntPtr context);
    [DllImport(Library)] static extern void mxg_library_unref(IntPtr library);
    [DllImport(Library)] static extern int mxg_document_load(IntPtr context, IntPtr library, byte[] path, out IntPtr document);
    [DllImport(Library)] static extern IntPtr mxg_document_diagnostics(IntPtr document);
    [DllImport(Library)] static extern void mxg_document_destroy(IntPtr document);
    [DllImport(Library)] static extern int mxg_generate(IntPtr context, IntPtr document, ref GenerateDesc desc, out IntPtr result);
    [DllImport(Library)] static extern IntPtr mxg_result_diagnostics(IntPtr result);
    [DllImport(Library)] static extern IntPtr mxg_result_source(IntPtr result, int stage, out UIntPtr size);
    [DllImport(Library)] static extern void mxg_result_destroy(IntPtr result);
    [DllImport(Library)] static extern uint mxg_diagnostics_num_items(IntPtr list);
    [DllImport(Library)] static extern UIntPtr mxg_diagnostics_format(IntPtr list, uint index, byte[] line, UIntPtr lineSize,
        [MarshalAs(UnmanagedType.I1)] bool colour, byte[] buffer, UIntPtr capacity);

    // Texts of mxgen are UTF-8.
    static byte[] Utf8(string text)
    {
        return Encoding.UTF8.GetBytes(text + "\0");
    }

    static void PrintDiagnostics(IntPtr list)
    {
        for (uint index = 0; index < mxg_diagnostics_num_items(list); ++index) {
            int size = (int)mxg_diagnostics_format(list, index, null, UIntPtr.Zero, false, null, UIntPtr.Zero);
            byte[] text = new byte[size + 1];
            mxg_diagnostics_format(list, index, null, UIntPtr.Zero, false, text, (UIntPtr)text.Length);
            Console.Error.WriteLine(Encoding.UTF8.GetString(text, 0, size));
        }
    }

    static int Generate(IntPtr context, IntPtr document, out IntPtr result)
    {
        GCHandle target = GCHandle.Alloc(Utf8("glsl"), GCHandleType.Pinned);
        GenerateDesc desc = new GenerateDesc { Size = (UIntPtr)Marshal.SizeOf(typeof(GenerateDesc)), Target = target.AddrOfPinnedObject() };
        int status = mxg_generate(context, document, ref desc, out result);
        target.Free();
        PrintDiagnostics(mxg_result_diagnostics(result));
        return status;
    }

    static void PrintSource(IntPtr result)
    {
        UIntPtr size;
        IntPtr source = mxg_result_source(result, Pixel, out size);
        byte[] text = new byte[(int)size];
        Marshal.Copy(source, text, 0, text.Length);
        Console.WriteLine(Encoding.UTF8.GetString(text));
    }

    static int Main(string[] arguments)
    {
        if (arguments.Length != 1) {
            Console.Error.WriteLine("usage: Minimal MATERIAL.mtlx");
            return 2;
        }
        IntPtr context, document, result = IntPtr.Zero;
        if (mxg_context_create(IntPtr.Zero, out context) != Ok)
            return 1;
        IntPtr library = mxg_library_builtin(context);
        int status = mxg_document_load(context, library, Utf8(arguments[0]), out document);
        PrintDiagnostics(mxg_document_diagnostics(document));
        if (status == Ok)
            status = Generate(context, document, out result);
        if (status == Ok)
            PrintSource(result);
        mxg_result_destroy(result); // null is allowed everywhere here
        mxg_document_destroy(document);
        mxg_library_unref(library);
        mxg_context_destroy(context);
        return status == Ok ? 0 : 1;
    }
}
