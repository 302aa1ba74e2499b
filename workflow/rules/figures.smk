# All figures: a rule draw_<name> for each entry of report/figures.yaml, from files alone.

for name, about in FIGURES.items():

    rule:
        name:
            f"draw_{name}"
        input:
            **about["inputs"],
        output:
            **drawn(about),
        log:
            f"results/logs/draw/{about['file']}.log",
        group:
            "figures"
        resources:
            mem_mb=1000,
            runtime=5,
        params:
            code=code_of("draw", f"figures.{about['module']}"),
            module=about["module"],
            settings=as_json({key: about[key] for key in ("inputs", "options")}),
            caption=caption_of(about),
        message:
            "draw {output.svg}"
        shell:
            "sedfiber draw {params.module} --settings {params.settings:q}"
            " --svg {output.svg} --png {output.png} > {log} 2>&1"


rule figures:
    input:
        figures_of("study"),
