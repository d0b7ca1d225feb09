"""Compiles with Slang's library, which the package slangpy carries without its command-line program.

    slang.py FOLDER OUTPUT INPUT [arguments of slangc ...]

FOLDER holds the library. Exit status: 0 compiled, 1 refused, 2 no library.
"""

import ctypes
import glob
import sys

POINTER = ctypes.c_void_p


def main(folder, output, source, *arguments):
    libraries = glob.glob(f"{folder}/**/libslang-compiler.so*", recursive=True)
    if not libraries:
        print(f"slang.py: no Slang in {folder}: tests/stacks/install gets it", file=sys.stderr)
        return 2
    slang = ctypes.CDLL(sorted(libraries)[0])
    for name, result, parameters in [
        ("spCreateSession", POINTER, [ctypes.c_char_p]),
        ("spCreateCompileRequest", POINTER, [POINTER]),
        ("spProcessCommandLineArguments", ctypes.c_int, [POINTER, ctypes.POINTER(ctypes.c_char_p), ctypes.c_int]),
        ("spCompile", ctypes.c_int, [POINTER]),
        ("spGetDiagnosticOutput", ctypes.c_char_p, [POINTER]),
        ("spGetEntryPointCode", POINTER, [POINTER, ctypes.c_int, ctypes.POINTER(ctypes.c_size_t)]),
    ]:
        function = getattr(slang, name)
        function.restype, function.argtypes = result, parameters
    request = slang.spCreateCompileRequest(slang.spCreateSession(None))
    # Without a file's name on its command line the library keeps no code of an entry point.
    words = [word.encode() for word in (source, *arguments, "-o", output)]
    status = slang.spProcessCommandLineArguments(request, (ctypes.c_char_p * len(words))(*words), len(words))
    if status >= 0:
        status = slang.spCompile(request)
    size = ctypes.c_size_t()
    code = slang.spGetEntryPointCode(request, 0, ctypes.byref(size)) if status >= 0 else None
    if not code:
        print((slang.spGetDiagnosticOutput(request) or b"").decode(), file=sys.stderr)
        return 1
    with open(output, "wb") as file:
        file.write(ctypes.string_at(code, size.value))
    return 0


sys.exit(main(*sys.argv[1:]))
