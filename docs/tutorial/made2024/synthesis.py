"""The central controller of Doyle, Glover, Khargonekar and Francis (1989) at a given level."""


def central(data):
    """Controller matrices A_k, B_k, C_k; the coupling condition must hold."""
    import numpy as np
    from scipy.linalg import solve_continuous_are

    A, B1, B2, C1, C2 = (data.float(name) for name in ("A", "B1", "B2", "C1", "C2"))
    level = data.float("level")
    weight = np.diag([1.0, -(level**2), -(level**2)])
    X = solve_continuous_are(A, np.hstack([B2, B1]), C1.T @ C1, weight)
    Y = solve_continuous_are(A.T, np.hstack([C2.T, C1.T]), B1 @ B1.T, weight)
    F, L, Z = -B2.T @ X, -Y @ C2.T, np.linalg.inv(np.eye(2) - Y @ X / level**2)
    A_k = A + B1 @ B1.T @ X / level**2 + B2 @ F + Z @ L @ C2
    coupling = max(abs(np.linalg.eigvals(X @ Y))) / level**2
    return {"A_k": A_k, "B_k": -Z @ L, "C_k": F, "coupling": float(coupling)}
