"""Compiling of the functions of the kernel: each is optimised once, with the function that Python calls.

Numba optimises a function anew in each function above it, and makes machine code of it each time. Here a
function has two compiled forms: a part, intermediate code that becomes machine code in the functions above
it, and for calls from Python a whole, which is kept in the folder of compiled code.
"""

from functools import cached_property, update_wrapper

import numba
import numpy as np
from llvmlite import ir
from llvmlite.binding import parse_assembly
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import Compiler
from numba.extending import intrinsic, typeof_impl

from swtstudy.kernel.cache import FOLDER, KeptCode, compiling


class _Part(JITCodeLibrary):
    """The code of a part."""

    def finalize(self):
        """Give the function's environment the address at which Numba sets it; optimise and emit nothing."""
        self._raise_if_finalized()
        variables = self._final_module.global_variables
        environment = [str(each) for each in variables if each.name.startswith("_ZN08NumbaEnv")]
        self._codegen._add_module(parse_assembly("\n".join(environment)))
        self._finalized = True


class _Whole(JITCodeLibrary):
    """The code of a whole."""

    def finalize(self):
        """Take in the parts of the parts, too, before all is optimised."""
        for library in self._linking_libraries:  # which grows
            more = dict.fromkeys(library._linking_libraries)
            self._linking_libraries += [each for each in more if each not in self._linking_libraries]
        super().finalize()


def _compiler_into(kind):
    """Numba's compiler, with another kind of library for the code of a function."""

    class Own(Compiler):
        def define_pipelines(self):
            state = self.state
            state.library = kind(state.targetctx.codegen(), state.func_id.func_qualname)
            state.library.enable_object_caching()
            return super().define_pipelines()

    return Own


_TO_PART, _TO_WHOLE = _compiler_into(_Part), _compiler_into(_Whole)


class Compiled:
    """A function that is compiled when it is first called."""

    def __init__(self, function, reordered):
        update_wrapper(self, function)
        self._options = {"error_model": "numpy", "nogil": True, "no_cfunc_wrapper": True}
        self._options["fastmath"] = reordered
        self._is_ready = False

    @cached_property
    def part(self):
        """Numba's dispatcher for calls from compiled functions."""
        options = self._options | {"pipeline_class": _TO_PART, "no_cpython_wrapper": True}
        made = numba.njit(**options)(self.__wrapped__)
        template = made.get_call_template

        def call_template(arguments, keywords):
            # A call with a literal such as 0 uses the code for all integers: Numba would compile it anew.
            return template(tuple(numba.types.unliteral(each) for each in arguments), keywords)

        made.get_call_template = call_template
        return made

    @cached_property
    def whole(self):
        """Numba's dispatcher for calls from Python."""
        made = numba.njit(**self._options, pipeline_class=_TO_WHOLE)(self.__wrapped__)
        if FOLDER:
            made._cache = KeptCode(self.__wrapped__)
        return made

    def __call__(self, *arguments):
        if not self._is_ready:
            with compiling(f"{self.__module__}.{self.__name__}"):
                self.whole.compile(tuple(map(numba.typeof, arguments)))
            self._is_ready = True
        return self.whole(*arguments)


@typeof_impl.register(Compiled)
def _type_of_part(function, context):
    """Numba's type of a function within compiled functions."""
    return numba.types.Dispatcher(function.part)


def jit(function):
    """Compile a function: division by zero as in NumPy, no lock held."""
    return function if numba.config.DISABLE_JIT else Compiled(function, reordered=False)


def jit_reordered(function):
    """Compile a loop over finite numbers whose order of summation does not matter."""
    return function if numba.config.DISABLE_JIT else Compiled(function, reordered=True)


def _extreme(name):
    """The larger or smaller of two numbers by the processor's instruction: loops with it are vectorised."""
    if numba.config.DISABLE_JIT:
        return {"max": max, "min": min}[name]

    @intrinsic
    def extreme(typing_context, one, other):
        def code(context, builder, signature, arguments):
            kind = ir.FunctionType(ir.DoubleType(), [ir.DoubleType()] * 2)
            own = builder.module.declare_intrinsic(f"llvm.{name}num", [ir.DoubleType()], kind)
            return builder.call(own, arguments)

        return numba.float64(numba.float64, numba.float64), code

    return extreme


larger, smaller = _extreme("max"), _extreme("min")


def fields(kind, names, *shape):
    """Fields of a record that are of one kind and shape, by their names with blanks between them."""
    return [(name, kind, *shape) for name in names.split()]


def new_record(kind):
    """A record of zeros whose fields are attributes, also where nothing is compiled."""
    return new_records(1, kind)[0]


def new_records(count, kind):
    """An array of such records."""
    return np.zeros(count, kind).view(np.recarray)
