# The trained model as a page of its own. The parts of the page are no Python: they are named here.


rule make_explorer:
    input:
        parts=page_parts(),
        model=[
            *model_files("results/models/forecast"),
            "results/models/forecast/terminal_curve.parquet",
        ],
        datasets=expand("results/dataset/{split}.parquet", split=STUDY.splits),
    output:
        "results/explorer.html",
    log:
        "results/logs/make_explorer.log",
    params:
        code=code_of("make_explorer"),
        model=lambda wildcards, input: Path(input.model[0]).parent,
    shell:
        "sedfiber make_explorer --model {params.model} --dataset {input.datasets} -o {output} > {log} 2>&1"


rule explorer:
    input:
        rules.make_explorer.output,
