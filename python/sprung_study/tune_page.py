"""tune.html: what matters, what it trades, and how the search went. Plots are Optuna's own, by Plotly, in one file."""
import html


def page(study: dict, search, summary: dict, line: str) -> str:
    names = summary["goals"]
    parts = [f"<h1>Tuning {html.escape(study['study'])}</h1>",
             f"<p>{summary['trials']['COMPLETE']} sets of numbers on every plant, {summary['trials']['PRUNED']} given up "
             f"on the way, {summary['runs']} runs; made by <code>{html.escape(line)}</code></p>",
             "<h2>The best</h2>", best_table(study, summary), held_out_table(summary)]
    for title, figure in figures(search, names):
        parts += [f"<h2>{html.escape(title)}</h2>", figure.to_html(full_html=False, include_plotlyjs=len(parts) == 5)]
    style = "body{font-family:sans-serif;max-width:70em;margin:2em auto}td,th{padding:.2em .8em;text-align:left}"
    return (f"<!doctype html><html lang=en><meta charset=utf-8><title>Tuning {html.escape(study['study'])}</title>"
            f"<style>{style}</style><body>" + "\n".join(parts) + "</body></html>\n")


def table(head: list, rows: list) -> str:
    cells = "".join(f"<th>{html.escape(str(one))}</th>" for one in head)
    body = "".join("<tr>" + "".join(f"<td>{html.escape(str(one))}</td>" for one in row) + "</tr>" for row in rows)
    return f"<table><tr>{cells}</tr>{body}</table>"


def best_table(study: dict, summary: dict) -> str:
    rows = [(one["path"], f"{one['present']:g} {one['unit']}", f"{summary['best'].get(one['path'], one['present']):g} {one['unit']}",
             f"{one['from']:g} to {one['to']:g}") for one in study["parameters"]]
    return table(["number", "robot.yaml's", "best", "looked for in"], rows)


def held_out_table(summary: dict) -> str:
    if not summary["held_out"]:
        return "<p>No plants were held out.</p>"
    rows = [(" ".join(plant), *(f"{a:.4g} -> {b:.4g}" for a, b in zip(present, best)))
            for plant, present, best in zip(summary["plants_held_out"], summary["held_out"]["present"],
                                            summary["held_out"]["best"])]
    return "<h2>On plants that were held out, robot.yaml's numbers -> the best</h2>" + table(["plant", *summary["goals"]], rows)


def figures(search, names: list):
    import optuna
    from optuna import visualization as show

    several = len(names) > 1
    whole = [t for t in search.trials if t.state.name == "COMPLETE"]
    # PED-ANOVA needs no other package, and asks what makes a set one of the good ones.
    judge = optuna.importance.PedAnovaImportanceEvaluator()
    for i, name in enumerate(names):
        target = {"target": lambda t, i=i: t.values[i], "target_name": name} if several else {}
        if len(whole) > 4 and len(whole[0].params) > 1:
            yield f"What matters for {name}", show.plot_param_importances(search, evaluator=judge, **target)
        yield f"{name} by each number", show.plot_slice(search, **target)
        yield f"{name}, trial by trial", show.plot_optimization_history(search, **target)
    if 1 < len(names) < 4:
        yield "What is traded", show.plot_pareto_front(search, target_names=names)
