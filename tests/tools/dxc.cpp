// A small command-line driver for the DirectX shader compiler's shared library.
//
//   dxc LIBRARY INPUT.hlsl OUTPUT [compiler arguments...]
//   dxc LIBRARY --version
//
// The Python package that the tests take the library from holds the library and its two headers, but
// not the `dxc` program, so this file stands in for it. Compiler arguments are the real program's
// (-T, -E, -spirv, -O0, ...). Diagnostics, warnings included, go to stderr.
//
// Exit status: 0 compiled, 1 the compiler refused the input, 2 it could not be tried at all.

#include <dlfcn.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "WinAdapter.h" // what dxcapi.h needs of Windows: HRESULT, COM identifiers, CComPtr
#include "dxcapi.h"

namespace {

constexpr int COMPILED = 0, REFUSED = 1, NOT_TRIED = 2;

int not_tried(const char *what, const char *detail) {
    std::fprintf(stderr, "dxc: %s: %s\n", what, detail);
    return NOT_TRIED;
}

// The compiler takes wide strings. Paths and flags of the tests are ASCII, so widening is enough.
std::wstring widen(const char *text) { return std::wstring(text, text + std::strlen(text)); }

int print_version(IDxcCompiler3 *compiler) {
    CComPtr<IDxcVersionInfo2> version;
    UINT32 major = 0, minor = 0, commits = 0;
    char *commit = nullptr;
    if (FAILED(compiler->QueryInterface(&version)) || FAILED(version->GetVersion(&major, &minor)) ||
        FAILED(version->GetCommitInfo(&commits, &commit)))
        return not_tried("no version information", "too old a library");
    std::printf("dxc %u.%u (%u commits, %s)\n", major, minor, commits, commit);
    return COMPILED;
}

int compile(IDxcCompiler3 *compiler, IDxcIncludeHandler *includes, const char *input, const char *output,
            const std::vector<const char *> &arguments) {
    std::ifstream input_file(input, std::ios::binary);
    if (!input_file) return not_tried("cannot read", input);
    const std::string source{std::istreambuf_iterator<char>(input_file), {}};

    // A leading argument without a dash names the file in diagnostics and anchors #include "...".
    std::vector<std::wstring> wide{widen(input)};
    for (const char *argument : arguments) wide.push_back(widen(argument));
    std::vector<LPCWSTR> pointers;
    for (const std::wstring &argument : wide) pointers.push_back(argument.c_str());

    const DxcBuffer buffer{source.data(), source.size(), DXC_CP_UTF8};
    CComPtr<IDxcResult> result;
    if (FAILED(compiler->Compile(&buffer, pointers.data(), UINT32(pointers.size()), includes,
                                 IID_PPV_ARGS(&result))))
        return not_tried("the compiler failed on", input);

    CComPtr<IDxcBlobUtf8> diagnostics;
    result->GetOutput(DXC_OUT_ERRORS, IID_PPV_ARGS(&diagnostics), nullptr);
    if (diagnostics && diagnostics->GetStringLength() > 0)
        std::fputs(diagnostics->GetStringPointer(), stderr);

    HRESULT status = E_FAIL;
    if (FAILED(result->GetStatus(&status)) || FAILED(status)) return REFUSED;

    CComPtr<IDxcBlob> object;
    if (FAILED(result->GetOutput(DXC_OUT_OBJECT, IID_PPV_ARGS(&object), nullptr)) || !object)
        return not_tried("no object code for", input);
    std::ofstream output_file(output, std::ios::binary);
    output_file.write(static_cast<const char *>(object->GetBufferPointer()),
                      std::streamsize(object->GetBufferSize()));
    output_file.close(); // here, so that a full disk shows
    return output_file ? COMPILED : not_tried("cannot write", output);
}

} // namespace

int main(int count, char **values) {
    const bool version = count == 3 && std::strcmp(values[2], "--version") == 0;
    if (count < 4 && !version)
        return not_tried("usage", "dxc LIBRARY INPUT.hlsl OUTPUT [arguments...] | dxc LIBRARY --version");

    // The library is never closed: it runs destructors of its own when the program ends.
    void *library = dlopen(values[1], RTLD_NOW);
    if (!library) return not_tried("cannot load the library", dlerror());
    const auto create = reinterpret_cast<DxcCreateInstanceProc>(dlsym(library, "DxcCreateInstance"));
    if (!create) return not_tried("not the compiler's library", values[1]);

    CComPtr<IDxcCompiler3> compiler;
    CComPtr<IDxcUtils> utilities;
    CComPtr<IDxcIncludeHandler> includes;
    if (FAILED(create(CLSID_DxcCompiler, IID_PPV_ARGS(&compiler))) ||
        FAILED(create(CLSID_DxcUtils, IID_PPV_ARGS(&utilities))) ||
        FAILED(utilities->CreateDefaultIncludeHandler(&includes)))
        return not_tried("cannot start the compiler in", values[1]);

    if (version) return print_version(compiler);
    return compile(compiler, includes, values[2], values[3],
                   std::vector<const char *>(values + 4, values + count));
}
