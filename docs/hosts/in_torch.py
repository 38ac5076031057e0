"""A contact and its friction in PyTorch, with derivatives. Tried with torch 2.14.1 on a CPU, beside differences."""

import numpy as np
import torch

import mdr


class Step(torch.autograd.Function):
    """F, new = Step.apply(u, state, element, dt), all of float64. Its derivative is dF/du, in one step."""

    @staticmethod
    def forward(ctx, u, state, element, dt):
        """The step, and its tangent for later."""
        F, new, K = map(torch.from_numpy, element.step(state.detach().numpy(), dt, u.detach().numpy(), tangent=True))
        ctx.save_for_backward(K)
        ctx.set_materialize_grads(False)
        return F, new

    @staticmethod
    def backward(ctx, of_F, of_new):
        """The derivative in u of what has these derivatives in F."""
        if ctx.needs_input_grad[1] or of_new is not None:
            raise RuntimeError("no derivative through the memory of a contact: hand over state.detach()")
        return (ctx.saved_tensors[0].mT @ of_F[..., None])[..., 0], None, None, None


class Friction(torch.autograd.Function):
    """cof = Friction.apply(x, make, inputs, v_0): of the contact make(*x), x being the values of its inputs."""

    @staticmethod
    def forward(ctx, x, make, inputs, v_0):
        """The COF, and its derivatives for later."""
        found = mdr.sensitivity(make(*x.tolist()), v_0, inputs)
        for reason in found.why["cof"].values():
            raise ValueError(reason)
        ctx.save_for_backward(torch.from_numpy(np.array([*found.d_cof.values()])))
        return x.new_tensor(found.cof)

    @staticmethod
    def backward(ctx, of_cof):
        """The derivatives in x of what has this derivative in the COF."""
        return of_cof * ctx.saved_tensors[0], None, None, None
