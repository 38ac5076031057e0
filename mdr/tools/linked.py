"""Compilation of functions that compiled ones alone call: they become machine code with the functions that call them.

numba makes machine code of each function with all that it calls, as if Python called it, and once more in each
function that calls it. Of an inner function nobody needs that: it is translated (to the intermediate representation
of LLVM) and no more. Its callers are optimised with it, as they are anyway. This takes three tenths off the time that
compiling takes. It uses parts of numba that are not promised: where they are gone, `LINKED` is empty, and numba's own
way is taken.
"""

# mypy: disallow-untyped-calls=false
from __future__ import annotations

from typing import Any

LINKED: dict[str, Any]  #: options of numba's njit for an inner function

try:
    from numba.core.codegen import JITCodeLibrary
    from numba.core.compiler import CompilerBase, DefaultPassBuilder
    from numba.core.compiler_machinery import register_pass
    from numba.core.typed_passes import NativeLowering

    class _Translated(JITCodeLibrary):
        """The code of an inner function and of those that it calls, to be linked into that of its callers."""

        def finalize(self) -> None:
            """Link what it calls; neither optimised nor made machine code."""
            self._raise_if_finalized()
            for library in dict.fromkeys(self._linking_libraries):
                self._final_module.link_in(library._get_module_for_linking(), preserve=True)
            self._finalize_dynamic_globals()
            self._finalized = True

    @register_pass(mutates_CFG=True, analysis_only=False)
    class _Translation(NativeLowering):
        _name = "translation"

        def run_pass(self, state: Any) -> bool:
            """What numba's lowering does, less the machine code."""
            library = state.library = _Translated(state.targetctx.codegen(), state.func_id.func_qualname)
            state.flags.no_compile = True
            super().run_pass(state)
            key: Any = set[int]().pop  # a function of its own, as numba asks for, which answers no call
            state.targetctx.insert_user_function(key, state["cr"].fndesc, [library])
            state["cr"] = state["cr"]._replace(cfunc=key)
            return True

    class _Inner(CompilerBase):
        def define_pipelines(self) -> list[Any]:
            """numba's passes, with the translation in the place of the lowering."""
            passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
            passes.passes = [(_Translation if one is NativeLowering else one, why) for one, why in passes.passes]
            passes.finalize()
            return [passes]

    LINKED = {"pipeline_class": _Inner}
except (ImportError, AttributeError):
    LINKED = {}
